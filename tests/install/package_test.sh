#!/usr/bin/env bash
# Makes the Debian package and uses it where nothing else of vlbeam is.
#   package_test.sh CPACK BUILD
set -euo pipefail
cpack=$1 build=$2
for tool in dpkg-deb dpkg-shlibdeps; do
  command -v $tool > /dev/null || { echo "$tool is not installed: skipped"; exit 77; }
done
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
says() { echo "FAILED: $1" >&2; exit 1; }

"$cpack" --config "$build/CPackConfig.cmake" -B "$scratch/packages" > "$scratch/log" 2>&1 || { cat "$scratch/log"; exit 1; }
package=$(echo "$scratch"/packages/vlbeam_*.deb)
dpkg-deb --field "$package" Depends | grep libc6 > /dev/null || says "it depends on nothing"
[[ vlbeam\ $(dpkg-deb --field "$package" Version) == "$("$build/vlbeam" --version)" ]] || says "its version"

root=$scratch/root
dpkg-deb --extract "$package" "$root"
cd "$scratch"
"$root/usr/bin/vlbeam" list | grep "  pendulum  " > /dev/null || says "its scenes"

# A root that has the libraries of the program, and no more.
if [[ $(id -u) -eq 0 ]]; then
  ldd "$root/usr/bin/vlbeam" | grep -o '/[^ ]*' | while read -r library; do
    mkdir -p "$root$(dirname "$library")" && cp -L "$library" "$root$library"
  done
  mkdir "$root/tmp"
  # Without /proc a program cannot tell where it stands, nor give a file its name.
  chroot "$root" /usr/bin/vlbeam scene pendulum --scenes /usr/share/vlbeam/scenes > "$root/tmp/scene.json" ||
    says "a scene in a clean root"
  chroot "$root" /usr/bin/vlbeam run /tmp/scene.json --report - -q > "$root/tmp/r.json" || says "a run in a clean root"
  grep -q '"status": "completed"' "$root/tmp/r.json" || says "its report"
fi
echo "packaged and used"
