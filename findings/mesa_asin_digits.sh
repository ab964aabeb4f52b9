#!/usr/bin/env bash
# asin and acos of GLSL have three to four correct digits in Mesa. A shader in single precision,
# with seven digits elsewhere, gets an angle that is wrong by up to 0.0004. atan has five digits,
# sin all. GLSL leaves the precision of asin open, so this is valid.
set -euo pipefail
suite=trixie
packages=base-files,gcc,libc6-dev,libegl-dev,libgl-dev,libgl1-mesa-dri=25.0.7-2+deb13u1

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mirror=$(apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' 'Origin: Debian' |
         head -n1)
apt-config dump --format '%F "%v";%n' Acquire::Check-Valid-Until Acquire::Check-Date >"$folder/apt"
mmdebstrap --quiet --variant=extract --format=directory --aptopt="$folder/apt" \
  --include="$packages" $suite "$folder/root" "deb $mirror $suite main" || exit 2

cat >"$folder/root/finding.c" <<'END'
#define GL_GLEXT_PROTOTYPES
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GL/gl.h>
#include <math.h>
#include <stdio.h>
#define N 4096
static float value[N][4];
static GLuint shader(GLenum type, const char* text) {
  GLuint made = glCreateShader(type);
  return glShaderSource(made, 1, &text, NULL), glCompileShader(made), made;
}
static double worst(int k, double f(double)) {
  double most = 0;
  for (int i = 0; i < N; ++i) most = fmax(most, fabs(value[i][k] - f((i + 0.5) / N)));
  return most;
}
int main(void) {
  EGLDisplay display = eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, NULL, NULL);
  if (!eglInitialize(display, NULL, NULL) || !eglBindAPI(EGL_OPENGL_API) ||
      !eglMakeCurrent(display, 0, 0, eglCreateContext(display, NULL, NULL, NULL))) return 2;
  GLuint texture, buffer, program = glCreateProgram();
  glGenTextures(1, &texture), glBindTexture(GL_TEXTURE_2D, texture);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, N, 1, 0, GL_RGBA, GL_FLOAT, NULL);
  glGenFramebuffers(1, &buffer), glBindFramebuffer(GL_FRAMEBUFFER, buffer);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);
  glViewport(0, 0, N, 1);
  glAttachShader(program, shader(GL_VERTEX_SHADER, "#version 130\nvoid main() {"
      "gl_Position = vec4(vec2(gl_VertexID & 1, gl_VertexID >> 1) * 4. - 1., 0, 1); }"));
  glAttachShader(program, shader(GL_FRAGMENT_SHADER, "#version 130\nout vec4 c; void main() {"
      "float x = gl_FragCoord.x / 4096.; c = vec4(asin(x), acos(x), atan(x), sin(x)); }"));
  glLinkProgram(program), glUseProgram(program), glDrawArrays(GL_TRIANGLES, 0, 3);
  glReadPixels(0, 0, N, 1, GL_RGBA, GL_FLOAT, value);
  const double a = worst(0, asin), b = worst(1, acos), c = worst(2, atan), d = worst(3, sin);
  printf("%s, %s\n", (const char*)glGetString(GL_VERSION), (const char*)glGetString(GL_RENDERER));
  printf("Expectation: errors between 0 and 1 are near 1e-7.\nBehaviour: the largest are asin "
         "%.1e, acos %.1e, atan %.1e, sin %.1e.\n", a, b, c, d);
  return !(a > 3e-4 && b > 1e-4 && c > 2e-6 && d < 2e-7);
}
END
chroot "$folder/root" /usr/bin/gcc /finding.c -o /finding -lEGL -lGL -lm || exit 2
LIBGL_ALWAYS_SOFTWARE=1 chroot "$folder/root" /finding
