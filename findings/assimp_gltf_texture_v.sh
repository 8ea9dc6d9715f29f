#!/usr/bin/env bash
# Assimp turns a glTF model's texture coordinates upside down.
#
# Versions:   Debian 12, libassimp5 5.2.5~ds0-1+b1; the file is checked by npm's gltf-validator 2.0.0-dev.3.10
# Good guess: with no post-processing step asked for, the numbers in the file come back as they are: (0.25, 0.125).
# Seen:       (0.25, 0.875). glTF's origin is the picture's upper left, Assimp's own the lower left, and it converts;
#             with aiProcess_FlipUVs, which sounds like the opposite, the file's numbers come back.
. "$(dirname "$0")/lib.sh"
fetch libassimp5=5.2.5~ds0-1+b1 libassimp-dev=5.2.5~ds0-1+b1
python3 "$findings/gltf_model.py" "$work/model.gltf"
cat >"$work/texture.cpp" <<'CPP'
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <assimp/Importer.hpp>
#include <cstdio>
int main(int, char** arguments) {
  for (const auto& [name, steps] : {std::pair("plain", 0u), std::pair("flipped", unsigned{aiProcess_FlipUVs})}) {
    Assimp::Importer importer;
    const aiScene* scene = importer.ReadFile(arguments[1], steps);
    if (!scene || scene->mNumMeshes != 1) return 2;
    const aiVector3D& first = scene->mMeshes[0]->mTextureCoords[0][0];
    std::printf("%s_u %g\n%s_v %g\n", name, first.x, name, first.y);
  }
}
CPP
compile "$work/texture" "$work/texture.cpp" -lassimp
inside "$work/texture" "$work/model.gltf" | tee "$work/out"
gltf_errors "$work/model.gltf" | tee -a "$work/out"
seen 'v["errors"] == 0 && v["plain_u"] == 0.25 && v["plain_v"] == 0.875' "$work/out"
seen 'v["flipped_u"] == 0.25 && v["flipped_v"] == 0.125' "$work/out"
