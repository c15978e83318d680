# Clean Debian roots to build and test in: sourced by test-generations.sh and test-packages.sh.
# Needs root, debootstrap and the network; each root takes up to 5 GB below ${TMPDIR:-/tmp}.
mirror=${DEBIAN_MIRROR:-http://deb.debian.org/debian}

[ "$(id -u)" -eq 0 ] || { echo "error: not root; chroot and debootstrap ask for it" >&2; exit 2; }
command -v debootstrap >/dev/null || { echo "error: no debootstrap; apt-get install debootstrap" >&2; exit 2; }

make_root() { # RELEASE ROOT
  debootstrap --variant=minbase "$1" "$2" "$mirror" >"$2.debootstrap" || { tail -n 5 "$2.debootstrap" >&2; return 1; }
  cp /etc/resolv.conf "$2/etc/resolv.conf"
  # What apt needs to be told here (a proxy, a mirror that lags behind) it needs to be told there.
  cp -n /etc/apt/apt.conf.d/* "$2/etc/apt/apt.conf.d/"
}

in_root() { # ROOT COMMAND ...: its mounts are gone with the command
  unshare --mount --propagation private bash -c '
    root=$1; shift
    mount -t proc proc "$root/proc" && mkdir -p "$root/dev/shm" && mount -t tmpfs tmpfs "$root/dev/shm"
    mount -t sysfs -o ro sysfs "$root/sys" # without it MPI complains on standard output
    exec chroot "$root" env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin LANG=C.UTF-8 "$@"' _ "$@"
}
