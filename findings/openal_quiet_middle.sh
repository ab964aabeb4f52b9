#!/usr/bin/env bash
# OpenAL Soft plays a mono source quieter in front of the listener than at the side, in stereo: each
# channel has 0.596 of the amplitude instead of 0.707. The power is 1.5 dB lower. A source that goes
# from left to right at a constant distance thus sounds farther away in the middle.
set -euo pipefail
suite=trixie
packages=base-files,gcc,libc6-dev,libopenal-dev=1:1.24.2-1

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mirror=$(apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' 'Origin: Debian' |
         head -n1)
apt-config dump --format '%F "%v";%n' Acquire::Check-Valid-Until Acquire::Check-Date >"$folder/apt"
mmdebstrap --quiet --variant=extract --format=directory --aptopt="$folder/apt" \
  --include="$packages" $suite "$folder/root" "deb $mirror $suite main" || exit 2

cat >"$folder/root/finding.c" <<'END'
#define AL_ALEXT_PROTOTYPES
#include <AL/al.h>
#include <AL/alc.h>
#include <AL/alext.h>
#include <math.h>
#include <stdio.h>
enum { N = 12000 };
static float tone[N], heard[2 * N];
int main(void) {
  ALCdevice* device = alcLoopbackOpenDeviceSOFT(NULL);
  const ALCint stereo[] = {ALC_FORMAT_CHANNELS_SOFT, ALC_STEREO_SOFT, ALC_FORMAT_TYPE_SOFT,
                           ALC_FLOAT_SOFT, ALC_FREQUENCY, 48000, 0};
  if (!device || !alcMakeContextCurrent(alcCreateContext(device, stereo))) return 2;
  for (int i = 0; i < N; ++i) tone[i] = sinf(2 * 3.14159265f * i / 48);
  ALuint buffer, source;
  alGenBuffers(1, &buffer), alGenSources(1, &source);
  alBufferData(buffer, AL_FORMAT_MONO_FLOAT32, tone, sizeof tone, 48000);
  alSourcei(source, AL_BUFFER, (ALint)buffer);
  printf("OpenAL %s\nExpectation: left^2 + right^2 is the same in each direction; in front both "
         "are 0.707.\nBehaviour: peaks of a tone of amplitude 1 are\n", alGetString(AL_VERSION));
  double power[3];
  for (int k = 0; k < 3; ++k) {
    const double angle = k * 3.14159265 / 4, x = cos(angle);
    alSource3f(source, AL_POSITION, (float)x, 0, (float)-sin(angle));
    alSourcePlay(source), alcRenderSamplesSOFT(device, heard, N), alSourceStop(source);
    double peak[2] = {0, 0};
    for (int i = N; i < 2 * N; ++i) peak[i % 2] = fmax(peak[i % 2], fabsf(heard[i]));
    power[k] = peak[0] * peak[0] + peak[1] * peak[1];
    printf("  x = %.2f: left %.3f, right %.3f, power %.3f\n", x, peak[0], peak[1], power[k]);
    alcRenderSamplesSOFT(device, heard, N);
  }
  return !(fabs(power[0] - 1) < 0.02 && fabs(power[2] - 0.71) < 0.02);
}
END
chroot "$folder/root" /usr/bin/gcc /finding.c -o /finding -lopenal -lm || exit 2
export LD_LIBRARY_PATH=/usr/lib/x86_64-linux-gnu/pulseaudio
chroot "$folder/root" /finding
