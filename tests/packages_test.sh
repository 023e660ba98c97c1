#!/usr/bin/env bash
# Makes the Debian packages of a build and looks at them: packages_test.sh BUILD. Exit code 77: something is missing here.
set -euo pipefail
sources="$(cd "$(dirname "$0")/.." && pwd)"
build="$1"
for tool in cpack dpkg-shlibdeps dpkg-deb lintian pkg-config; do
  command -v "$tool" >/dev/null || { echo "skipped: $tool is missing (scripts/setup doors)"; exit 77; }
done
[ -f "$build/CPackConfig.cmake" ] || { echo "skipped: $build was configured without dpkg-shlibdeps"; exit 77; }
place="$(mktemp -d)"
trap 'rm -rf "$place"' EXIT
failed() { echo "packages: $1" >&2; exit 1; }
umask 022

(cd "$build" && cpack -B "$place/debs" -D CPACK_DEBIAN_COMPRESSION_TYPE=gzip >"$place/cpack.txt" 2>&1) ||
  { tail -20 "$place/cpack.txt"; exit 1; }
debs=("$place"/debs/*.deb)
[ "$(basename -a "${debs[@]}" | sed 's/_.*//' | paste -sd' ')" = "cotan libcotan-dev libcotan0 python3-cotan" ] ||
  failed "expected four packages, found ${debs[*]}"

# Two warnings are of no concern here: there is no bug tracker, and a build for /usr/local has no folder per architecture.
lintian --allow-root --fail-on error,warning \
  --suppress-tags initial-upload-closes-no-bugs,pkg-config-unavailable-for-cross-compilation "${debs[@]}"

# A file is in one package; all that an installation has is in one, but for the licence, which is its copyright file.
for deb in "${debs[@]}"; do
  name="$(basename "$deb" | sed 's/_.*//')"
  dpkg-deb -c "$deb" | awk '$1 !~ /^d/ { sub(/^\.\/usr\//, "", $6); print $6 }' | sort >"$place/$name.files"
done
sort "$place"/*.files | uniq -d >"$place/twice"
[ ! -s "$place/twice" ] || failed "in two packages: $(cat "$place/twice")"
cmake --install "$build" --prefix "$place/installed" >/dev/null
(cd "$place/installed" && find . ! -type d -printf '%P\n') | sed 's/\(man1\/.*\.1\)$/\1.gz/' | grep -v '^share/doc/' |
  sort >"$place/whole"
sort "$place"/*.files | grep -v -e '^share/doc/' -e '^lib/python3/' | comm -3 - "$place/whole" >"$place/differ"
[ ! -s "$place/differ" ] || failed "in the packages or in an installation, not in both: $(cat "$place/differ")"
expect() { grep -qx "$2" "$place/$1.files" || failed "$1 lacks $2"; }
expect cotan bin/cotan
expect cotan bin/cotan-lab
expect cotan share/man/man1/cotan-lab.1.gz
expect cotan share/man/man1/cotan-map-convert.1.gz
expect cotan share/bash-completion/completions/cotan
expect cotan share/zsh/vendor-completions/_cotan
expect cotan share/fish/vendor_completions.d/cotan.fish
expect cotan 'lib.*/cotan/cotan_image_formats.so'
expect cotan 'lib.*/cotan/cotan_window.so'
expect libcotan0 'lib.*/libcotan.so.0'
expect libcotan-dev 'lib.*/libcotan.so'
expect libcotan-dev include/cotan.h
expect libcotan-dev include/cotan_old_names.h
expect libcotan-dev share/cotan/shaders/cotan/frame.h
expect python3-cotan lib/python3/dist-packages/cotan/py.typed
! grep -v -e '^share/doc/' -e '\.so\.[0-9.]*$' "$place/libcotan0.files" || failed "libcotan0 has more than a library"

# What the tool cannot do without is needed; the window's libraries are recommended, OpenImageIO is suggested.
field() { dpkg-deb -f "$place"/debs/"$1"_*.deb "$2"; }
[[ "$(field cotan Depends)" == *libembree3* && "$(field cotan Depends)" != *glfw* ]] || failed "Depends: $(field cotan Depends)"
[[ "$(field cotan Recommends)" == *libglfw3*libvulkan1* ]] || failed "Recommends: $(field cotan Recommends)"
[[ "$(field cotan Suggests)" == libopenimageio* ]] || failed "Suggests: $(field cotan Suggests)"
[[ "$(field python3-cotan Depends)" == libcotan0*python3-numpy* ]] || failed "Depends: $(field python3-cotan Depends)"

# The library's symbols, for packages that are built on it.
dpkg-deb -e "$place"/debs/libcotan0_*.deb "$place/control"
for deb in "${debs[@]}"; do dpkg-deb -x "$deb" "$place/root"; done
library="$(echo "$place"/root/usr/lib*/libcotan.so.0 "$place"/root/usr/lib/*/libcotan.so.0 | tr ' ' '\n' | while read -r f; do [ ! -e "$f" ] || echo "$f"; done | head -1)"
objdump -T "$library" | sed -n 's/.* \(COTAN_[0-9]*\) *\(cotan_[a-z0-9_]*\)$/\2@\1/p' | sort >"$place/exported"
sed -n 's/^ \(cotan_[a-z0-9_]*@COTAN_[0-9]*\) .*/\1/p' "$place/control/symbols" | sort >"$place/told"
diff "$place/exported" "$place/told" || failed "DEBIAN/symbols is not what the library exports"

# With nothing but the packages: the tool, its modules among them, from another folder than it was made for.
cd "$place"
usr="$place/root/usr"
[ "$("$usr/bin/cotan" --version)" = "cotan $(dpkg-deb -f debs/cotan_*.deb Version | sed 's/-.*//')" ] || failed "--version"
"$usr/bin/cotan" render --size 96x54 -o picture.png --quiet
"$usr/bin/cotan" render --size 96x54 -o picture.exr --quiet
[ -s picture.png ] && [ -s picture.exr ] || failed "the tool drew nothing"
# A module that lies in the folder where the tool is called is not loaded, even where its own is missing.
mkdir -p "$place/there/cotan"
echo '#include <stdio.h>
__attribute__((constructor)) static void run(void) { fclose(fopen("planted", "w")); }' |
  cc -shared -fPIC -x c - -o "$place/there/cotan/cotan_image_formats.so"
cp "$place/there/cotan/cotan_image_formats.so" "$place/there/cotan_image_formats.so"
own="$(find "$usr" -name cotan_image_formats.so)"
mv "$own" "$place/own.so"
(cd "$place/there" && PATH="$usr/bin:$PATH" && cotan render --size 16x9 -o picture.exr --quiet 2>/dev/null) || true
mv "$place/own.so" "$own"
[ ! -e "$place/there/planted" ] || failed "a module in the current folder was loaded"
# A program in C++ by CMake, one in C by pkg-config, and Python.
cmake -S "$sources/examples/find_package" -B example -G Ninja -DCMAKE_PREFIX_PATH="$usr" >cmake.txt || { cat cmake.txt; exit 1; }
cmake --build example >/dev/null
example/perturb
export PKG_CONFIG_PATH="$(dirname "$(find "$usr" -name cotan-c.pc)")" LD_LIBRARY_PATH="$(dirname "$library")"
cc -std=c99 "$sources/examples/c/main.c" $(pkg-config --cflags --libs cotan-c) -lm -o example_c
./example_c
for python in python3 /usr/bin/python3; do
  "$python" -c "import numpy" 2>/dev/null || continue
  PYTHONPATH="$usr/lib/python3/dist-packages" PYTHONDONTWRITEBYTECODE=1 "$python" -c "
import cotan, importlib.metadata
assert cotan.__file__.startswith('$usr') and importlib.metadata.version('cotan') == cotan.__version__
print('Python:', cotan.__version__)"
  break
done
echo "packages: $(wc -l <whole) files in four packages, made, looked through and used"
