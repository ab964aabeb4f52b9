#!/usr/bin/env bash
# GNU parallel of Debian 12 writes the exit value 0 to its --joblog for a job that a signal has
# ended, for example where memory runs out. Only the next column has the signal. A list of the jobs
# whose exit value is not 0 lacks those that were killed. Version 20240222 writes 137.
set -euo pipefail
suite=bookworm
packages=base-files,bash,dash,coreutils,procps,parallel=20221122+ds-2

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mirror=$(apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' 'Origin: Debian' |
         head -n1)
apt-config dump --format '%F "%v";%n' Acquire::Check-Valid-Until Acquire::Check-Date >"$folder/apt"
mmdebstrap --quiet --variant=extract --format=directory --aptopt="$folder/apt" \
  --include="$packages" $suite "$folder/root" "deb $mirror $suite main" || exit 2

cat >"$folder/root/finding" <<'END'
export LC_ALL=C HOME=/tmp
parallel --version | head -n1
jobs=('exit 0' 'exit 3' 'kill -KILL $$' 'kill -TERM $$')
echo "Expectation: the log has the exit values of a shell:"
for job in "${jobs[@]}"; do
  code=0
  sh -c "$job" 2>/dev/null || code=$?
  echo "  $code: $job"
done 2>/dev/null
parallel --jobs 1 --joblog /log eval ::: "${jobs[@]}" || echo "parallel ends with $?, failed jobs."
echo "Behaviour: Exitval and Signal of the log are"
tail -n +2 /log | cut -f7,8 | tr '\t' ' ' | tee /rows
[[ $(paste -sd, /rows) == '0 0,3 0,0 9,0 15' ]]
END
unshare --mount sh -c 'mount -t proc proc "$1/proc" && chroot "$1" /bin/bash /finding' - \
  "$folder/root"
