# The lab's first process, second half: drivers, then the command.
/run/lab/bin/busybox --install -s /run/lab/bin
export PATH=/run/lab/bin:/usr/sbin:/sbin:/usr/bin:/bin
share=/run/lab/share
exec >"/dev/$(ls /sys/class/virtio-ports)" 2>&1 # the one port there is

/lib/systemd/systemd-udevd --daemon || echo "lab: no udevd: hot-plugging will not be seen"
modprobe vivid n_devs=2 node_types=0x101,0x1 multiplanar=1,2 # a camera and an output; a camera of many planes
modprobe vhci-hcd
modprobe uvcvideo
modprobe vimc
modprobe v4l2loopback devices=1 video_nr=40 card_label=Loopback exclusive_caps=1
udevadm settle --timeout=60

bash "$share/command" </dev/null
echo $? >"$share/status"
sync
poweroff -f
