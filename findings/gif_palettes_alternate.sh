#!/usr/bin/env bash
# The GIF encoder of ffmpeg leaves out pixels whose index is that of the previous picture. With one
# palette per picture it does so as well where a picture has the palette of the first one and its
# predecessor another: equal indices are different colours. Red and green in turn become red once,
# then green for ever. The flags -offsetting-transdiff write whole pictures.
set -euo pipefail
suite=trixie
packages=base-files,bash,coreutils,python3-minimal,ffmpeg=7:7.1.5-0+deb13u1

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mirror=$(apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' 'Origin: Debian' |
         head -n1)
apt-config dump --format '%F "%v";%n' Acquire::Check-Valid-Until Acquire::Check-Date >"$folder/apt"
mmdebstrap --quiet --variant=extract --format=directory --aptopt="$folder/apt" \
  --include="$packages" $suite "$folder/root" "deb $mirror $suite main" || exit 2

cat >"$folder/root/finding.py" <<'END'
import subprocess, sys

red, green, blue = bytes([200, 0, 0]), bytes([0, 200, 0]), bytes([0, 0, 255])
pictures = [red, green, red, green, red]
raw = ["-f", "rawvideo", "-pix_fmt", "rgb24"]
palettes = "split[a][b];[a]palettegen=stats_mode=single[p];[b][p]paletteuse=new=1:dither=none"

def run(arguments, data=b""):
    return subprocess.run(["ffmpeg", "-v", "error", *arguments], input=data, check=True,
                          capture_output=True).stdout

def colours(flags):
    """The colour in the upper half of each picture of a GIF, as ffmpeg decodes it."""
    film = b"".join(colour * 512 + blue * 512 for colour in pictures)
    run([*raw, "-s", "32x32", "-r", "10", "-i", "-", "-filter_complex", palettes, *flags, "-y",
         "film.gif"], film)
    back = run(["-i", "film.gif", *raw, "-"])
    return [{red: "red", green: "green"}[back[k:k + 3]] for k in range(0, len(back), 3072)]

print(subprocess.run(["ffmpeg", "-version"], capture_output=True, text=True).stdout.split("\n")[0])
print("Expectation: red, green, red, green, red.")
default, whole = colours([]), colours(["-gifflags", "-offsetting-transdiff"])
print("Behaviour:", *default)
print("With whole pictures:", *whole)
sys.exit(default != ["red"] + 4 * ["green"] or whole != ["red", "green", "red", "green", "red"])
END
export LD_LIBRARY_PATH=/usr/lib/x86_64-linux-gnu/blas:/usr/lib/x86_64-linux-gnu/lapack
LD_LIBRARY_PATH+=:/usr/lib/x86_64-linux-gnu/pulseaudio
chroot "$folder/root" /usr/bin/python3.13 /finding.py
