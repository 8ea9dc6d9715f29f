#!/usr/bin/env bash
# Assimp's horizontal field of view of a glTF camera is the vertical one times the aspect ratio.
#
# Versions:   Debian 12, libassimp5 5.2.5~ds0-1+b1; the file is checked by npm's gltf-validator 2.0.0-dev.3.10
# Good guess: aiCamera::mHorizontalFOV is the horizontal angle that goes with glTF's yfov, 2 atan(aspect tan(yfov /
#             2)), or half of it.
# Seen:       yfov 0.6 rad and aspect 2 give 1.2 rad instead of 1.108: the picture's sides see 5 degrees more than
#             they should. The wider the lens, the more it is off.
. "$(dirname "$0")/lib.sh"
fetch libassimp5=5.2.5~ds0-1+b1 libassimp-dev=5.2.5~ds0-1+b1
python3 "$findings/gltf_model.py" "$work/camera.gltf"
cat >"$work/view.cpp" <<'CPP'
#include <assimp/scene.h>

#include <assimp/Importer.hpp>
#include <cmath>
#include <cstdio>
int main(int, char** arguments) {
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFile(arguments[1], 0);
  if (!scene || scene->mNumCameras != 1) return 2;
  std::printf("assimp %.5f\naspect %.5f\nright %.5f\n", scene->mCameras[0]->mHorizontalFOV, scene->mCameras[0]->mAspect,
              2 * std::atan(2 * std::tan(0.3)));
}
CPP
compile "$work/view" "$work/view.cpp" -lassimp
inside "$work/view" "$work/camera.gltf" | tee "$work/out"
gltf_errors "$work/camera.gltf" | tee -a "$work/out"
seen 'v["errors"] == 0 && v["aspect"] == 2 && (v["right"] - 1.10807)^2 < 1e-8' "$work/out"
seen '(v["assimp"] - 1.2)^2 < 1e-8' "$work/out"
