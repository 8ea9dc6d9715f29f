#!/usr/bin/env bash
# validate.sh VALIDATOR ROOT SHADER LISTED STAMP: checks one entry shader with glslangValidator: once for each of its
# lines
#     // variant: NAME NAME=VALUE ...
# with these symbols defined, once for each line "PATH NAME=VALUE ..." of the file LISTED that names it, and once plain
# where it has a line `// variant:` alone or nothing at all. Makes the file STAMP when all are right.
#
# Reading GLSL's own functions takes the validator most of its time: it gets all variants at once, as files with their
# includes and symbols written in. It reads but does not link them, so the first is linked too: one function that calls
# itself, or none called main, is wrong in every variant.
set -euo pipefail
validator=$1 root=$2 shader=$3 listed=$4 stamp=$5
work=$stamp.variants
rm -rf "$work"
mkdir -p "$work"

# The shader below its line #version, each included file once, as render/gl/shader_source.cpp puts it together.
awk -v root="$root" -v shader="$shader" '
  function add(path, line, number, name) {
    added[path] = 1
    if (path != shader) print "#line 1 \"shaders/" path "\""
    while ((getline line < (root "/" path)) > 0) {
      ++number
      if (path == shader && number == 1) {
        print "#line 2 \"shaders/" path "\""
      } else if (line ~ /^[ \t]*#[ \t]*include[ \t]+"/) {
        name = line
        sub(/^[^"]*"/, "", name)
        sub(/".*/, "", name)
        if (!(name in added)) add(name)
        print "#line " (number + 1) " \"shaders/" path "\""
      } else {
        print line
      }
    }
    if (number == 0) { print "shaders/" path ": absent or empty" > "/dev/stderr"; failed = 1 }
    close(root "/" path)
  }
  BEGIN { add(shader); exit failed }' >"$work/body"

mapfile -t variants < <(
  sed -nE 's|^// variant: *||p' "$root/$shader"
  sed -nE "s|^${shader//./\\.}( .*)?\$|\\1|p" "$listed"
)
[ ${#variants[@]} -gt 0 ] || variants=("")

version=$(head -n 1 "$root/$shader")
body=$(<"$work/body")
extension=${shader##*.}
files=()
for number in "${!variants[@]}"; do
  symbols=
  for word in ${variants[$number]}; do
    [[ $word == *=* ]] || word+="=1"
    symbols+="#define ${word/=/ }"$'\n'
  done
  # The extension says that a #line may name its file.
  printf '%s\n#extension GL_GOOGLE_include_directive : require\n%s%s\n' "$version" "$symbols" "$body" >"$work/$number.$extension"
  files+=("$number.$extension")
done

# check OPTION|FILE...: what the validator says of each file, under the symbols of its variant.
check() {
  local output line variant=
  output=$(cd "$work" && "$validator" "$@" 2>&1) && return
  while IFS= read -r line; do
    if [[ $line =~ ^([0-9]+)\.$extension$ ]]; then
      variant=${variants[${BASH_REMATCH[1]}]}
    elif [[ $line == ERROR* || $line == WARNING* ]]; then
      echo "shaders/$shader, variant [$variant]: $line"
    fi
  done <<<"$output" >&2
  return 1
}
check -l "0.$extension"
check "${files[@]}"
touch "$stamp"
rm -rf "$work"
