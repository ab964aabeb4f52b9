#version 330 core
// A finer picture, averaged over the samples of each pixel in linear light.

uniform sampler2D u_picture;  // sRGB: what is fetched is linear
uniform int u_samples;        // along each axis of a pixel

out vec4 o_colour;

vec3 srgb(vec3 c) {
  return mix(12.92 * c, 1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, c));
}

void main() {
  ivec2 corner = ivec2(gl_FragCoord.xy) * u_samples;
  vec4 sum = vec4(0.0);
  for (int y = 0; y < u_samples; ++y) {
    for (int x = 0; x < u_samples; ++x) sum += texelFetch(u_picture, corner + ivec2(x, y), 0);
  }
  vec4 mean = sum / float(u_samples * u_samples);
  o_colour = vec4(srgb(mean.rgb), mean.a);
}
