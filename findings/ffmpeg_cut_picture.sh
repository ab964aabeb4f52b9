#!/usr/bin/env bash
# ffmpeg ends with 0 if the last picture of its input is incomplete, as after the death of the
# program that writes to its pipe, and leaves this picture out. Of raw pictures it prints an error,
# of YUV4MPEG nothing. The flag -xerror makes the first a failure, and -err_detect explode neither.
set -euo pipefail
suite=trixie
packages=base-files,bash,coreutils,ffmpeg=7:7.1.5-0+deb13u1

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mirror=$(apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' 'Origin: Debian' |
         head -n1)
apt-config dump --format '%F "%v";%n' Acquire::Check-Valid-Until Acquire::Check-Date >"$folder/apt"
mmdebstrap --quiet --variant=extract --format=directory --aptopt="$folder/apt" \
  --include="$packages" $suite "$folder/root" "deb $mirror $suite main" || exit 2

cat >"$folder/root/finding" <<'END'
# Two and a half pictures of 64 x 48 pixels.
raw() { head -c $((5 * 64 * 48 * 4 / 2)) /dev/zero; }
y4m() {
  echo "YUV4MPEG2 W64 H48 F25:1 C444"
  for bytes in 9216 9216 4608; do echo FRAME; head -c $bytes /dev/zero; done
}
encode() {  # FUNCTION FLAG...: prints exit code, pictures, lines of messages
  local code=0
  "$1" | ffmpeg -v error -y "${@:2}" -i - -c:v ffv1 film.mkv 2>messages || code=$?
  echo "$code $(ffprobe -v error -count_frames -show_entries stream=nb_read_frames \
    -of csv=p=0 film.mkv) $(wc -l <messages)"
}
declare -A found
size=(-f rawvideo -pix_fmt rgba -s 64x48)
found[raw]=$(encode raw "${size[@]}")
found[explode]=$(encode raw -err_detect explode "${size[@]}")
found[xerror]=$(encode raw -xerror "${size[@]}")
found[y4m]=$(encode y4m -xerror -f yuv4mpegpipe)
ffmpeg -version | head -n1 | cut -d' ' -f1-3
echo "Expectation: two and a half pictures are an error: the exit code is not 0."
echo "Behaviour: exit code, pictures of the film and lines of messages are"
for input in raw explode xerror y4m; do echo "  $input: ${found[$input]}"; done
[[ ${found[raw]} == '0 2 '[1-9] && ${found[explode]} == '0 2 '[1-9] &&
   ${found[xerror]} != '0 '* && ${found[y4m]} == '0 2 0' ]]
END
export LD_LIBRARY_PATH=/usr/lib/x86_64-linux-gnu/blas:/usr/lib/x86_64-linux-gnu/lapack
LD_LIBRARY_PATH+=:/usr/lib/x86_64-linux-gnu/pulseaudio
chroot "$folder/root" /bin/bash -euo pipefail /finding
