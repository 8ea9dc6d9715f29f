# shellcheck shell=bash
# What the scripts of this folder share; sourced, not run. Gives them:
#   $work        an empty temporary folder, removed at the end
#   $root        where fetched Debian packages are unpacked (nothing is installed in the system)
#   fetch        downloads and unpacks exactly the named versions, and what they need that the system lacks
#   fetch_opencv, fetch_ffmpeg, fetch_mesa  the same for those
#   compile      compiles one C++ source against $root
#   inside       runs a command with $root's programs and libraries first; on_llvmpipe on Mesa's as well
#   seen         fails the script unless a condition on the printed numbers holds
# Exit status: 0 the behaviour is as written down, 1 it has changed, 2 it could not be tried.
set -euo pipefail
findings=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
work=$(mktemp -d)
root=$work/root
trap 'rm -rf "$work"' EXIT
triplet=$(dpkg-architecture -qDEB_HOST_MULTIARCH 2>/dev/null || echo x86_64-linux-gnu)

cannot() {
  echo "could not be tried: $*" >&2
  exit 2
}

trap 'cannot "line $LINENO of $0 failed"' ERR

# fetch NAME=VERSION ...: FINDINGS_DEBS names a folder that keeps the downloads from one run to the next.
fetch() {
  local debs=${FINDINGS_DEBS:-$work/debs} apt wanted file
  mkdir -p "$debs/partial" "$work/none/partial" "$root"
  apt=(apt-get -qq -y --no-install-recommends --allow-downgrades -o Debug::NoLocking=1)
  [ "$(id -u)" != 0 ] || apt+=(-o APT::Sandbox::User=root)
  "${apt[@]}" -o "Dir::Cache::archives=$work/none" --print-uris install "$@" >"$work/lacking" 2>"$work/apt.log" ||
    cannot "no such versions here (apt-get update?): $*: $(tail -n 1 "$work/apt.log")"
  "${apt[@]}" -o "Dir::Cache::archives=$debs" --download-only install "$@" >"$work/apt.log" 2>&1 ||
    cannot "download failed: $(tail -n 1 "$work/apt.log")"
  while read -r _ file _; do
    case $file in libc6_* | libc-bin_* | '') ;;  # a C library beside its own loader would not start
    *) dpkg -x "$debs/$file" "$root" ;; esac
  done <"$work/lacking"
  for wanted in "$@"; do  # those that the system has already were not downloaded above
    file=$(deb_of "$wanted" "$debs")
    if [ -z "$file" ]; then
      (cd "$debs" && "${apt[@]}" download "$wanted" >"$work/apt.log" 2>&1) || cannot "download of $wanted failed"
      file=$(deb_of "$wanted" "$debs")
    fi
    dpkg -x "$file" "$root"
  done
}

# deb_of NAME=VERSION FOLDER: the package's file, or nothing.
deb_of() {
  local version=${1#*=}
  find "$2" -maxdepth 1 -name "${1%%=*}_${version//:/%3a}_*.deb" | head -n 1
}

# compile PROGRAM SOURCE [FLAGS]: C++17; headers and libraries of $root are found before the system's.
compile() {
  local program=$1 source=$2
  shift 2
  command -v g++ >/dev/null || cannot "no g++"
  g++ -std=c++17 -O2 -o "$program" "$source" -I"$findings" -isystem "$root/usr/include" "$@" \
    -L"$root/usr/lib/$triplet" -Wl,-rpath-link,"$root/usr/lib/$triplet" || cannot "$source does not compile"
}

inside() {
  LD_LIBRARY_PATH=$root/usr/lib/$triplet:$root/usr/lib/$triplet/blas:$root/usr/lib/$triplet/lapack \
    PATH=$root/usr/bin:$PATH "$@"
}

# seen CONDITION FILE: the condition is awk's, over the lines "name value" that FILE holds: seen 'v["rms"] < 0.1' out.
seen() {
  if ! awk "{ v[\$1] = \$2 } END { exit !($1) }" "$2"; then
    echo "CHANGED: no longer true: $1" >&2
    cat "$2" >&2
    exit 1
  fi
}

# fetch_opencv MODULE ...: OpenCV 4.6's libraries and headers.
fetch_opencv() {
  local module wanted=()
  for module in "$@"; do wanted+=("libopencv-${module}406=4.6.0+dfsg-12" "libopencv-${module}-dev=4.6.0+dfsg-12"); done
  fetch "${wanted[@]}"
}

# fetch_ffmpeg: FFmpeg 5.1's program and the libraries that it runs on.
fetch_ffmpeg() {
  local package wanted=()
  for package in ffmpeg libavcodec59 libavfilter8 libavformat59 libavutil57 libswscale6; do
    wanted+=("$package=7:5.1.9-0+deb12u1")
  done
  fetch "${wanted[@]}"
}

# fetch_mesa: Mesa 22.3's software rasteriser, and what a program needs to reach it through EGL without a display.
fetch_mesa() {
  local package wanted=(libllvm15=1:15.0.6-4+b1)
  for package in libegl-mesa0 libgl1-mesa-dri libglapi-mesa libgbm1; do wanted+=("$package=22.3.6-1+deb12u2"); done
  for package in libegl1 libgles2 libglvnd0 libegl-dev libgles-dev; do wanted+=("$package=1.6.0-1"); done
  fetch "${wanted[@]}"
}

# on_llvmpipe: runs a command against fetch_mesa's llvmpipe.
on_llvmpipe() {
  LIBGL_ALWAYS_SOFTWARE=1 GALLIUM_DRIVER=llvmpipe LIBGL_DRIVERS_PATH=$root/usr/lib/$triplet/dri \
    __EGL_VENDOR_LIBRARY_FILENAMES=$root/usr/share/glvnd/egl_vendor.d/50_mesa.json inside "$@"
}

# gltf_errors FILE: prints how many errors the Khronos validator finds in it.
gltf_errors() {
  command -v npm >/dev/null || cannot "no npm"
  npm install --silent --no-audit --no-fund --prefix "$work/npm" gltf-validator@2.0.0-dev.3.10 >"$work/npm.log" 2>&1 ||
    cannot "npm: $(tail -n 1 "$work/npm.log")"
  NODE_PATH=$work/npm/node_modules node -e '
    require("gltf-validator").validateBytes(new Uint8Array(require("fs").readFileSync(process.argv[1])))
      .then(report => console.log("errors", report.issues.numErrors + report.issues.numWarnings))' "$1"
}
