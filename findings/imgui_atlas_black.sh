#!/usr/bin/env bash
# Dear ImGui 1.92 fills the transparent texels between the letters of its RGBA atlas with black.
# In 1.90 they are white. A renderer with a linear filter and straight alpha, as of every
# backend of Dear ImGui, mixes this black into the edges of scaled letters.
set -euo pipefail
suite=sid
package=libimgui-dev=1.92.2b+ds-1+b1

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mirror=$(apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' 'Origin: Debian' |
         head -n1)
apt-config dump --format '%F "%v";%n' Acquire::Check-Valid-Until Acquire::Check-Date >"$folder/apt"
mmdebstrap --quiet --variant=extract --format=directory --aptopt="$folder/apt" \
  --include="base-files,g++,$package" $suite "$folder/root" "deb $mirror $suite main" || exit 2

cat >"$folder/root/finding.cpp" <<'END'
#include <imgui.h>
#include <cstdio>
int main() {
  ImGui::CreateContext();
  ImGui::GetIO().Fonts->AddFontDefault();
  unsigned char* texels;
  int width, height;
  ImGui::GetIO().Fonts->GetTexDataAsRGBA32(&texels, &width, &height);
  int white = 0, black = 0, edges = 0;
  for (int k = 0; k + 1 < width * height; ++k) {
    const unsigned char *a = texels + 4 * k, *b = a + 4;
    white += a[3] == 0 && a[0] == 255;
    black += a[3] == 0 && a[0] == 0;
    edges += a[3] == 255 && b[3] == 0 && b[0] == 0;
  }
  std::printf("Dear ImGui %s\n", ImGui::GetVersion());
  std::printf("Expectation: letters are white, with their shape in alpha: no texel is dark.\n");
  std::printf("Behaviour: of the transparent texels %d are white and %d black. %d opaque texels\n"
              "have a black one to the right. The colour in the middle of such a pair is 127.\n",
              white, black, edges);
  return !(black > 1000 && edges > 100);
}
END
chroot "$folder/root" \
  /usr/bin/g++ -I/usr/include/imgui /finding.cpp -o /finding -limgui -lstb -lm || exit 2
chroot "$folder/root" /finding
