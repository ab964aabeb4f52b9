#!/usr/bin/env bash
# ffmpeg writes GIF films of more than 100 pictures a second with all pictures, each for 0.01 s. The
# film lasts longer than its input, at 240 pictures a second 2.4 times as long. ffmpeg ends with 0,
# and warns of non-monotonic DTS. Delays of GIF are whole multiples of 0.01 s.
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

def delays(rate):
    """Pictures, sum of their delays in 0.01 s, and warnings, of a film of one second."""
    source = f"testsrc=size=32x32:rate={rate}:duration=1"
    done = subprocess.run(["ffmpeg", "-v", "warning", "-y", "-f", "lavfi", "-i", source,
                           "film.gif"], capture_output=True, text=True, check=True)
    data, found = open("film.gif", "rb").read(), []
    def colours(flags):
        return 3 << (flags % 8 + 1) if flags & 128 else 0
    place = 13 + colours(data[10])
    while data[place] != 0x3B:
        if data[place:place + 2] == b"\x21\xf9":
            found.append(int.from_bytes(data[place + 4:place + 6], "little"))
        place += 2 if data[place] == 0x21 else 11 + colours(data[place + 9])
        while data[place]:
            place += data[place] + 1
        place += 1
    return len(found), sum(found), done.stderr.count("DTS")

print(subprocess.run(["ffmpeg", "-version"], capture_output=True, text=True).stdout.split("\n")[0])
print("Expectation: a film of one second lasts one second. Pictures are left out where needed.")
print("Behaviour:")
results = []
for rate in 50, 60, 100, 120, 240:
    pictures, length, warnings = delays(rate)
    results.append((pictures, length, warnings > 0))
    print(f"  {rate} a second: {pictures} pictures, {length / 100} s, {warnings} warnings")
sys.exit(results != [(50, 100, False), (60, 100, False), (100, 100, False), (120, 120, True),
                     (240, 240, True)])
END
export LD_LIBRARY_PATH=/usr/lib/x86_64-linux-gnu/blas:/usr/lib/x86_64-linux-gnu/lapack
LD_LIBRARY_PATH+=:/usr/lib/x86_64-linux-gnu/pulseaudio
chroot "$folder/root" /usr/bin/python3.13 /finding.py
