#!/usr/bin/env bash
# HDF5 2.0 has another lower bound of its file format by default. Groups then store the time of their
# creation, as only datasets did before. Two runs of a program with equal data write unequal files.
# Reproducible archives need H5Pset_libver_bounds(..., H5F_LIBVER_EARLIEST, ...), or
# H5Pset_obj_track_times(..., false) for each group and for the file.
set -euo pipefail
suite=sid
package=libhdf5-dev=2.2.0+repack-6

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mirror=$(apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' 'Origin: Debian' |
         head -n1)
apt-config dump --format '%F "%v";%n' Acquire::Check-Valid-Until Acquire::Check-Date >"$folder/apt"
mmdebstrap --quiet --variant=extract --format=directory --aptopt="$folder/apt" \
  --include="base-files,gcc,$package" $suite "$folder/root" "deb $mirror $suite main" || exit 2

cat >"$folder/root/finding.c" <<'END'
#include <hdf5.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>
static size_t written(int oldest, char* bytes, size_t most) {
  const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
  if (oldest) H5Pset_libver_bounds(access, H5F_LIBVER_EARLIEST, H5F_LIBVER_LATEST);
  const hid_t file = H5Fcreate("f.h5", H5F_ACC_TRUNC, H5P_DEFAULT, access);
  H5Gclose(H5Gcreate2(file, "run", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
  H5Fclose(file);
  FILE* stream = fopen("f.h5", "rb");
  const size_t size = fread(bytes, 1, most, stream);
  fclose(stream);
  return size;
}
static int equal(int oldest) {
  static char first[100000], second[100000];
  const size_t size = written(oldest, first, sizeof first);
  sleep(2);
  return size == written(oldest, second, sizeof second) && memcmp(first, second, size) == 0;
}
int main(void) {
  unsigned major, minor, release;
  H5get_libversion(&major, &minor, &release);
  printf("HDF5 %u.%u.%u\nExpectation: a file with an empty group has the same bytes, whenever it is"
         " written.\n", major, minor, release);
  const int usual = equal(0), oldest = equal(1);
  printf("Behaviour: two seconds later the bytes are %s by default, and %s with the earliest format.\n",
         usual ? "equal" : "unequal", oldest ? "equal" : "unequal");
  return usual || !oldest;
}
END
chroot "$folder/root" /usr/bin/gcc -I/usr/include/hdf5/serial /finding.c -o /finding -lhdf5_serial ||
  exit 2
chroot "$folder/root" /finding
