#!/usr/bin/env bash
# Prepares the kernel of the camera lab: Debian's own, downloaded once, with two drivers compiled for it from Debian's
# sources that it does not bring: vimc (a camera made of media entities) and v4l2loopback (an output device). Prints
# the folder that holds vmlinux, version and lib/modules; says on stderr why it cannot.
set -euo pipefail
PATH=$PATH:/usr/sbin:/sbin

cache=${XDG_CACHE_HOME:-$HOME/.cache}/skyshaft/lab
mkdir -p "$cache"
exec 9>"$cache/lock"
flock 9

image=$(apt-cache depends --important linux-image-amd64 | sed -n 's/^ *Depends: \(linux-image-.*\)/\1/p' | head -n 1)
[ -n "$image" ] || { echo "apt knows no linux-image-amd64" >&2; exit 1; }
version=${image#linux-image-}
version=${version%-unsigned}
done=$cache/$version
if [ -e "$done/complete" ]; then
  echo "$done"
  exit
fi

work=$(mktemp -d "$cache/making.XXXXXX")
trap 'rm -rf "$work"' EXIT
series=$(grep -oE '^[0-9]+\.[0-9]+' <<<"$version")
headers=linux-headers-$version
common=$(apt-cache depends --important "$headers" | sed -n 's/^ *Depends: \(linux-headers-.*common\)/\1/p')
kbuild=$(apt-cache depends --important "$headers" | sed -n 's/^ *Depends: \(linux-kbuild-.*\)/\1/p')
mkdir "$work/debs"
echo "lab: downloading the kernel $version and the sources of two drivers (once)" >&2
(cd "$work/debs" && apt-get -qq -o APT::Sandbox::User=root download \
  "$image" "$headers" "$common" "$kbuild" "linux-source-$series" v4l2loopback-dkms >&2) ||
  { echo "apt-get could not download the kernel's packages" >&2; exit 1; }

# Half of the package is drivers of graphics, network and sound, of no use here.
new=$work/new
mkdir -p "$new"
dpkg-deb --fsys-tarfile "$work"/debs/linux-image-*.deb | tar -x -C "$new" --exclude=./usr/share \
  --exclude='*/kernel/drivers/gpu' --exclude='*/kernel/drivers/net' --exclude='*/kernel/sound'
[ -d "$new/lib/modules" ] || { mkdir -p "$new/lib" && mv "$new/usr/lib/modules" "$new/lib/"; }
# QEMU enters an unpacked kernel directly; unpacking it under emulation would take seconds each time.
vmlinuz=$new/boot/vmlinuz-$version
skip=$(LC_ALL=C grep -abo -m1 $'\xfd7zXZ' "$vmlinuz" | head -n 1 | cut -d: -f1)
tail -c "+$((skip + 1))" "$vmlinuz" | xz -dc --single-stream >"$new/vmlinux" 2>/dev/null || true
[ "$(head -c 4 "$new/vmlinux")" = $'\x7fELF' ] || cp "$vmlinuz" "$new/vmlinux"

echo "lab: compiling vimc and v4l2loopback for it (once)" >&2
for package in "$work"/debs/linux-headers-*.deb "$work"/debs/linux-kbuild-*.deb "$work"/debs/v4l2loopback-*.deb; do
  dpkg-deb -x "$package" "$work/build"
done
dpkg-deb --fsys-tarfile "$work"/debs/linux-source-*.deb | tar -xO "./usr/src/linux-source-$series.tar.xz" |
  tar -xJ -C "$work" --strip-components=4 "linux-source-$series/drivers/media/test-drivers/vimc"
tree=$work/build/usr/src/$headers
sed -i "s#/usr/src/#$work/build/usr/src/#" "$tree/Makefile"
mkdir -p "$new/lib/modules/$version/extra"
for driver in "$work/vimc" "$work"/build/usr/src/v4l2loopback-*; do
  make -C "$tree" "M=$driver" CONFIG_VIDEO_VIMC=m CONFIG_DEBUG_INFO_BTF_MODULES= modules >"$work/make.log" 2>&1 ||
    { tail -n 20 "$work/make.log" >&2; echo "$(basename "$driver") did not compile" >&2; exit 1; }
  strip --strip-debug "$driver"/*.ko
  cp "$driver"/*.ko "$new/lib/modules/$version/extra/"
done
depmod -b "$new" "$version" 2>/dev/null
echo "$version" >"$new/version"
touch "$new/complete"
rm -rf "$done"
mv "$new" "$done"
echo "$done"
