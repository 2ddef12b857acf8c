# shellcheck shell=bash
# Boots Debian's standard kernel with our programs in QEMU, to test with the real drivers but without
# devices. Source this file in a script:
#     vm_require                            exits with code 77 and a message if a tool is missing
#     vm_fetch_kernel WORK                  downloads and unpacks the kernel package into WORK, once
#     vm_boot WORK NAME SCRIPT MODULES PROGRAM...  boots and runs SCRIPT in the guest NAME; returns 0 if it passed
#
# The guest has virtual time (-icount): it stops while the host is busy and jumps ahead while the
# guest is idle. So tests do not fail under load and do not wait, but times measured in the guest are
# meaningless. An instruction takes 2^VM_TICK ns of virtual time (default: 2 ns); with a smaller
# VM_TICK, the guest does more in the same virtual time. SCRIPT is a shell script; it finds WORK/share
# in /share, and the PROGRAMs with their libraries in /bin. Log: WORK/NAME.log. Guests of different names can run at
# the same time.

vm_packages="busybox-static cpio kmod qemu-system-x86 seabios xz-utils"

vm_require() {
  local tool missing=
  for tool in busybox cpio depmod qemu-system-x86_64 xz apt-get dpkg; do
    command -v "$tool" > /dev/null || missing+=" $tool"
  done
  [ -z "$missing" ] && return
  echo "***Skipped: tests with real drivers need$missing: apt-get install $vm_packages"
  exit 77
}

# Unpacks the kernel here, because its own decompressor would take a minute on an emulated processor. The
# compressed kernel starts at the first xz header of the image.
vm_extract_kernel() {
  local offset
  offset=$(LC_ALL=C grep -abo -m 1 -P '\xFD7zXZ\x00' "$1" | head -n 1 | cut -d : -f 1)
  # xz fails at the data after the compressed kernel, but only after it has unpacked the kernel.
  tail -c +$((offset + 1)) "$1" | xz -dc 2> /dev/null > "$2" || [ -s "$2" ]
}

# Not the cloud kernel: it has no camera drivers.
vm_kernel_package() {
  apt-cache depends linux-image-amd64 2> /dev/null | awk '/Depends:/ {print $2; exit}' || true
}

vm_fetch_kernel() {
  local work=$1 package
  [ -e "$work/kernel.ready" ] && return
  rm -rf "${work:?}/kernel"
  mkdir -p "$work/kernel"
  package=$(vm_kernel_package)
  # A new system has no package lists yet.
  if [ -z "$package" ] && [ "$(id -u)" = 0 ]; then
    apt-get update -qq
    package=$(vm_kernel_package)
  fi
  (cd "$work" && apt-get -qq -o APT::Sandbox::User=root download "$package") || {
    echo "vm: the package ${package:-linux-image-amd64} cannot be downloaded: run apt-get update and check the network"
    return 1
  }
  dpkg -x "$work/$package"_*.deb "$work/kernel"
  rm "$work/$package"_*.deb
  echo "${package#linux-image-}" > "$work/version"
  vm_extract_kernel "$work"/kernel/boot/vmlinuz-* "$work/vmlinux"
  depmod -b "$work/kernel" "$(cat "$work/version")"
  touch "$work/kernel.ready"
}

# Prints the files of the modules and of their dependencies, in loading order.
vm_module_files() {
  local work=$1 module
  for module in $2; do
    modprobe -d "$work/kernel" -S "$(cat "$work/version")" --show-depends "$module"
  done | awk '$1 == "insmod" && !seen[$2]++ {print $2}'
}

vm_libraries() {
  local program
  for program in "$@"; do
    ldd "$program" 2> /dev/null | grep -oE '/[^ ]+'
  done | sort -u
}

vm_pack() {
  local work=$1 name=$2 script=$3 modules=$4 root=$1/$2.root file
  shift 4
  rm -rf "${root:?}"
  mkdir -p "$root"/{bin,dev,modules,proc,share,sys,tmp}
  cp "$(command -v busybox)" "$root/bin/busybox"
  cp "$@" "$root/bin/"
  cp "$(dirname "${BASH_SOURCE[0]}")/guest/init" "$root/init"
  cp "$script" "$root/script"
  vm_module_files "$work" "$modules" | while read -r file; do
    cp "$file" "$root/modules/"
    basename "$file" .ko >> "$root/modules/order"
  done
  vm_libraries "$@" | while read -r file; do
    mkdir -p "$root${file%/*}"
    cp -L "$file" "$root$file"
  done
  (cd "$root" && find . | cpio -o -H newc --quiet) > "$work/$name.initramfs"
  rm -rf "${root:?}"
}

vm_boot() {
  local work=$1 name=$2
  mkdir -p "$work/share"
  vm_pack "$@"
  timeout "${VM_TIMEOUT_S:-3600}" qemu-system-x86_64 -accel tcg -cpu max -smp 1 -m 1536 \
    -icount "shift=${VM_TICK:-1},sleep=off" -rtc clock=vm -nodefaults -display none -no-reboot \
    -serial "file:$work/$name.log" \
    -virtfs "local,path=$work/share,mount_tag=share,security_model=none" \
    -kernel "$work/vmlinux" -initrd "$work/$name.initramfs" -append 'console=ttyS0 panic=-1 quiet' < /dev/null ||
    echo "vm: QEMU was stopped after ${VM_TIMEOUT_S:-3600} s, or could not be started; see $work/$name.log"
  tr -d '\r' < "$work/$name.log" | sed -n '/^guest: /,$p'
  # The test passed only if this is the last line; after a kernel panic, for example, it is missing.
  tr -d '\r' < "$work/$name.log" | tail -n 5 | grep -q '^guest: passed$'
}
