# shellcheck shell=bash disable=SC2154  # The caller sets work and root.
# Fresh Debian systems in a folder, for the checks beside this file, which source it.
# Needs root, the network, debootstrap and wget. The caller sets: work, a folder for all that is kept;
# root, where the system goes.
mirror=http://deb.debian.org/debian
# What ccache keeps for the builds in these systems.
ccache=${FLYTRI_ROOT_CCACHE:-$work/ccache}

# needs WHAT TOOL...: ends the check named WHAT as skipped where a tool, root or mounts are missing.
# Mounts live in a namespace of the script's own, and end with it: it starts itself again there.
#     needs 'the package test' lintian -- "$@"
needs() {
  local what=$1 missing=
  shift
  set -- debootstrap wget "$@"
  while [ "$1" != -- ]; do
    command -v "$1" > /dev/null || missing+=" $1"
    shift
  done
  shift
  [ -n "${FLYTRI_MOUNTS_ALONE:-}" ] && return
  [ "$(id -u)" = 0 ] || missing+=" root"
  unshare --mount true 2> /dev/null || missing+=" mount-namespaces"
  [ -n "$missing" ] || wget -q --spider --timeout=20 --tries=2 "$mirror/dists/stable/Release" || missing+=" $mirror"
  [ -z "$missing" ] || skip "$what lacks$missing; see the head of $0"
  FLYTRI_MOUNTS_ALONE=1 exec unshare --mount "$0" "$@"
}

skip() {
  echo "***Skipped: $1"
  exit 77
}

# check WHAT COMMAND...: says that it was checked, and in how many seconds; what the command printed
# is shown where it fails.
check() {
  local what=$1 start=$SECONDS
  shift
  if "$@" > "$work/log" 2>&1; then
    echo "ok: $what ($((SECONDS - start)) s)"
  else
    echo "FAILED: $what: $*"
    tail -n 200 "$work/log"
    exit 1
  fi
}

in_root() { chroot "$root" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin LANG=C.UTF-8 HOME=/root \
  DEBIAN_FRONTEND=noninteractive CCACHE_DIR=/ccache \
  NODE_EXTRA_CA_CERTS=/etc/ssl/certs/ca-certificates.crt "$@"; }

# fresh_root RELEASE [ARCHITECTURE]: makes the bare system of a release, by its name, up to date. It
# is kept for a week; the packages that apt fetches, and what ccache has where it is installed, for
# longer. A second architecture's packages can be installed, too.
fresh_root() {
  local release=$1 base=$work/base-$1.tar
  find "$work" -maxdepth 1 -name "base-$release.tar" -mtime +7 -delete
  umount_root
  rm -rf --one-file-system "${root:?}"
  if [ -e "$base" ]; then
    mkdir -p "$root"
    tar -C "$root" -xf "$base"
  else
    # An older debootstrap does not know the names of newer releases; all are made as "sid" is.
    check "debootstrap $release" debootstrap --variant=minbase "$release" "$root" "$mirror" \
      /usr/share/debootstrap/scripts/sid
    tar -C "$root" -cf "$base.part" .
    mv "$base.part" "$base"
  fi
  write_sources "$release" > "$root/etc/apt/sources.list"
  cp /etc/resolv.conf "$root/etc/"
  # A network may have certificates of its own. ca-certificates takes them up when it is installed.
  mkdir -p "$root/usr/local/share"
  [ ! -d /usr/local/share/ca-certificates ] || cp -r /usr/local/share/ca-certificates "$root/usr/local/share/"
  echo force-unsafe-io > "$root/etc/dpkg/dpkg.cfg.d/fast"
  # Mirrors of a release to come may be late.
  echo 'Acquire::Check-Valid-Until "false";' > "$root/etc/apt/apt.conf.d/late"
  mkdir -p "$work/debs-$release/partial" "$ccache" "$root/ccache"
  mount --bind "$ccache" "$root/ccache"
  mount --bind "$work/debs-$release" "$root/var/cache/apt/archives"
  mount -t proc proc "$root/proc"
  mount --rbind /dev "$root/dev"
  [ -z "${2:-}" ] || in_root dpkg --add-architecture "$2"
  check 'the fresh system is up to date' in_root sh -c 'apt-get update && apt-get -y dist-upgrade'
}

write_sources() {
  echo "deb $mirror $1 main"
  # A release to come has none of these.
  case $1 in bookworm | trixie)
    echo "deb $mirror $1-updates main"
    echo "deb $mirror-security $1-security main" ;;
  esac
}

# All mounts below the root, the caller's own among them.
umount_root() {
  local mounted
  findmnt -rno TARGET | awk -v below="$root/" 'index($0, below) == 1' | sort -r |
    while read -r mounted; do umount "$mounted"; done
}

remove_root() {
  umount_root
  rm -rf --one-file-system "${root:?}"
}
