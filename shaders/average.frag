// Average of a supersampled picture over the samples of each pixel, in linear light.

uniform sampler2D u_picture;  // fetches return linear values, in OpenGL ES stored sRGB values
uniform int u_samples;        // samples per pixel along each axis
uniform bool u_transparent;   // whether the stored sRGB colours are premultiplied by alpha
uniform bool u_light_in;      // whether the picture is light times opacity, and opacity
uniform bool u_light_out;     // whether the output is this, times u_weight
uniform float u_weight;

out vec4 o_colour;

vec3 srgb(vec3 c) {
  return mix(12.92 * c, 1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, c));
}

vec3 light_of(vec3 c) {
  return mix(c / 12.92, pow((c + 0.055) / 1.055, vec3(2.4)), step(0.04045, c));
}

// Light times opacity of a sample, and its opacity.
vec4 sample_at(ivec2 place) {
  vec4 c = texelFetch(u_picture, place, 0);
#ifdef GL_ES
  if (!u_light_in) c.rgb = light_of(c.rgb);
#endif
  if (u_transparent && !u_light_in && c.a > 0.0) c.rgb = c.a * light_of(srgb(c.rgb) / c.a);
  return c;
}

void main() {
  ivec2 corner = ivec2(gl_FragCoord.xy) * u_samples;
  vec4 sum = vec4(0.0);
  for (int y = 0; y < u_samples; ++y) {
    for (int x = 0; x < u_samples; ++x) sum += sample_at(corner + ivec2(x, y));
  }
  vec4 mean = sum / float(u_samples * u_samples);
  if (u_light_out) {
    o_colour = u_weight * mean;
    return;
  }
  o_colour = vec4(srgb(mean.rgb), mean.a);
  if (u_transparent && mean.a > 0.0) o_colour.rgb = mean.a * srgb(mean.rgb / mean.a);
}
