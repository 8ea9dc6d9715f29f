#!/usr/bin/env bash
# boot.sh [-t SECONDS] -- COMMAND [ARG...]: runs a command, as root, against real camera drivers.
#
# Boots Debian's kernel in QEMU with this machine's own files (read-only; what is written there goes to memory and
# vanishes) and the drivers vivid, uvcvideo on a virtual USB host, vimc and v4l2loopback. The command's output comes
# out here, and its status is this script's. Needs no camera, no root, no network but for the first download.
# Status 77: it cannot boot here, with one line of why; 124: the time was up.
set -euo pipefail
PATH=$PATH:/usr/sbin:/sbin
here=$(cd "$(dirname "$0")" && pwd -P)

seconds=170
[ "${1:-}" != -t ] || { seconds=$2; shift 2; }
[ "${1:-}" != -- ] || shift
[ $# -gt 0 ] || { sed -n '2s/^# //p' "$0" >&2; exit 2; }

cannot() { echo "lab: cannot boot here: $*" >&2; exit 77; }
for program in qemu-system-x86_64 busybox cpio depmod xz strip gcc-12 make; do
  command -v "$program" >/dev/null || cannot "there is no $program"
done
work=$(mktemp -d "${TMPDIR:-/tmp}/skyshaft-lab.XXXXXX")
trap 'rm -rf "$work"; [ -z "${reader:-}" ] || kill "$reader" 2>/dev/null || true' EXIT
kernel=$("$here/kernel.sh" 2>"$work/why") || cannot "$(tail -n 1 "$work/why")"
version=$(cat "$kernel/version")

# The first files that the guest sees: busybox, the modules it takes to reach the others, and two scripts.
first=$work/first
mkdir -p "$first"/{bin,modules,proc,sys,dev,host,memory,new} "$work/share"
cp "$(command -v busybox)" "$first/bin/busybox"
cp "$here/guest_init.sh" "$first/init"
chmod 755 "$first/init"
number=100
for module in virtio_pci virtio_console 9pnet_virtio 9p overlay; do
  modprobe -d "$kernel" -S "$version" --show-depends "$module"
done | awk '$1 == "insmod" && !seen[$2]++ { print $2 }' >"$work/modules"
while read -r file; do
  case $file in
    *.xz) xz -dc "$file" >"$first/modules/$number.ko" ;;
    *) cp "$file" "$first/modules/$number.ko" ;;
  esac
  number=$((number + 1))
done <"$work/modules"
(cd "$first" && find . | cpio -o -H newc --quiet --owner=0:0) >"$work/initrd"

cp "$here/guest_main.sh" "$work/share/main"
echo "$kernel/lib/modules/$version" >"$work/share/modules"
pwd >"$work/share/folder"
{
  printf 'cd %q || exit 125\nexec env -i' "$PWD"
  printf ' %q' "PATH=$PATH" "HOME=/root" "LANG=C.UTF-8" SKYSHAFT_LAB=1 XDG_RUNTIME_DIR=/run "$@"
  printf '\n'
} >"$work/share/command"

# Processors without AVX: emulating it is slower than doing without.
machine=(-accel tcg,thread=multi -cpu Nehalem)
# A /dev/kvm that opens is no proof; the processor must offer it too.
[ -w /dev/kvm ] && grep -qwE 'vmx|svm' /proc/cpuinfo && machine=(-accel kvm -cpu host)
mkfifo "$work/out"
exec 8<>"$work/out" # so that neither end waits for the other to appear
cat "$work/out" 8>&- &
reader=$!
status=0
timeout -k 5 "$seconds" qemu-system-x86_64 \
  -nodefaults -no-user-config -display none -no-reboot -M q35 -smp "$(nproc)" -m 2048 "${machine[@]}" \
  -kernel "$kernel/vmlinux" -initrd "$work/initrd" \
  -append "console=ttyS0 loglevel=5 panic=-1 mitigations=off" -serial "file:$work/console" \
  -fsdev local,id=host,path=/,security_model=none,readonly=on,multidevs=remap \
  -device virtio-9p-pci,fsdev=host,mount_tag=host \
  -fsdev "local,id=share,path=$work/share,security_model=none" -device virtio-9p-pci,fsdev=share,mount_tag=share \
  -device virtio-serial-pci -chardev "file,id=out,path=$work/out" -device virtserialport,chardev=out,name=out \
  </dev/null 2>"$work/qemu.log" 8>&- || status=$?
exec 8>&-
wait "$reader"
reader=
if grep -aE 'BUG:|Oops|general protection fault|Kernel panic' "$work/console" >&2; then
  echo "lab: the guest's kernel complained" >&2
fi
[ ! -s "$work/share/status" ] || exit "$(cat "$work/share/status")"
[ "$status" != 124 ] || { echo "lab: the time was up after $seconds s" >&2; exit 124; }
tail -n 5 "$work/console" "$work/qemu.log" >&2 || true
cannot "the guest ended without a result"
