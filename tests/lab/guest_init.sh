#!/bin/busybox sh
# The lab's first process, first half: reach the host's files, and lay memory over them that takes the writes.
/bin/busybox --install -s /bin
export PATH=/bin
mount -t proc proc /proc
mount -t sysfs sys /sys
mount -t devtmpfs dev /dev
for module in /modules/*; do insmod "$module"; done

over9p=trans=virtio,version=9p2000.L,msize=512000
mount -t 9p -o "$over9p,ro,cache=loose" host /host || poweroff -f
mount -t tmpfs -o mode=755 memory /memory
mkdir /memory/upper /memory/work
mount -t overlay -o lowerdir=/host,upperdir=/memory/upper,workdir=/memory/work overlay /new || poweroff -f
mkdir /share /folder
mount -t 9p -o "$over9p,cache=none" share /share || poweroff -f
folder=$(cat /share/folder)
mount --bind "/new$folder" /folder
mount -t proc proc /new/proc
mount -t sysfs sys /new/sys
mount -t debugfs debugfs /new/sys/kernel/debug
mount -t devtmpfs dev /new/dev
mkdir -p /new/dev/shm
mount -t tmpfs -o mode=1777 shm /new/dev/shm
mount -t tmpfs -o mode=1777 tmp /new/tmp
mount -t tmpfs -o mode=755 run /new/run
[ -d "/new$folder" ] || { mkdir -p "/new$folder" && mount --bind /folder "/new$folder"; } # under /tmp
mkdir -p /new/run/lab/share /new/run/lab/bin
mount --bind /share /new/run/lab/share || poweroff -f
mkdir -p "/new/lib/modules/$(uname -r)"
mount --bind "/new$(cat /new/run/lab/share/modules)" "/new/lib/modules/$(uname -r)" || poweroff -f
ln -s /proc/self/fd /new/dev/fd
ifconfig lo 127.0.0.1 up
cp /bin/busybox /new/run/lab/bin/
exec switch_root /new /run/lab/bin/busybox sh /run/lab/share/main
