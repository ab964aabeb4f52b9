// A picture in stored sRGB values becomes linear light, or the reverse. The framebuffer or the
// texture, which has an sRGB format, makes the second conversion.

uniform sampler2D u_picture;
uniform bool u_to_light;

out vec4 o_colour;

vec3 srgb(vec3 c) {
  return mix(12.92 * c, 1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, c));
}

vec3 light_of(vec3 c) {
  return mix(c / 12.92, pow((c + 0.055) / 1.055, vec3(2.4)), step(0.04045, c));
}

void main() {
  vec4 c = texelFetch(u_picture, ivec2(gl_FragCoord.xy), 0);
  o_colour = vec4(u_to_light ? light_of(c.rgb) : srgb(c.rgb), c.a);
}
