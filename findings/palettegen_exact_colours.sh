#!/usr/bin/env bash
# palettegen of ffmpeg 7 changes colours that a palette has room for: it averages in OkLab with
# integers, also over pixels of one colour. 40 colours of a ramp come back with levels that are off
# by one, while greys are kept. A GIF of few colours is not lossless. ffmpeg 5.1 kept all of them.
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

raw = ["-f", "rawvideo", "-pix_fmt", "rgb24"]

def run(arguments, data=b""):
    return subprocess.run(["ffmpeg", "-v", "error", *arguments], input=data, check=True,
                          capture_output=True).stdout

def worst(colours):
    """The largest change of a level of colours that go through palettegen and paletteuse."""
    picture = b"".join(bytes(colour) * 16 for colour in colours)
    back = run([*raw, "-s", f"16x{len(colours)}", "-i", "-", "-filter_complex",
                "split[a][b];[a]palettegen[p];[b][p]paletteuse=dither=none", *raw, "-"], picture)
    return max(abs(a - b) for a, b in zip(picture, back))

print(subprocess.run(["ffmpeg", "-version"], capture_output=True, text=True).stdout.split("\n")[0])
print("Expectation: up to 255 colours are kept exactly.")
greys = worst([[k, k, k] for k in range(0, 256, 16)])
ramp = worst([[4 * k, 4 * k, 255 - 4 * k] for k in range(40)])
print(f"Behaviour: 16 greys change by up to {greys}, 40 colours of a ramp by up to {ramp}")
sys.exit((greys, ramp) != (0, 1))
END
export LD_LIBRARY_PATH=/usr/lib/x86_64-linux-gnu/blas:/usr/lib/x86_64-linux-gnu/lapack
LD_LIBRARY_PATH+=:/usr/lib/x86_64-linux-gnu/pulseaudio
chroot "$folder/root" /usr/bin/python3.13 /finding.py
