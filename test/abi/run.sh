#!/usr/bin/env bash
# Compare the binary interface of the modules with interface.txt: their exported functions with the types of their parameters, and
# the public types as types.awk prints them. Not seen: types that functions return, offsets, inline functions.
# ABIDW=... COMPILER=g++ run.sh LIBRARY_DIR INCLUDE_DIR...; VISP_DIRECT_UPDATE_INTERFACE=1 writes the file.
set -euo pipefail
export LC_ALL=C
libraries=$1
shift
skip() { echo "SKIPPED: $*"; exit 77; }
command -v "${ABIDW:-abidw}" >/dev/null || skip "abidw is missing (Debian package abigail-tools)"
command -v "${COMPILER:-g++}" >/dev/null || skip "${COMPILER:-g++} is missing, whose debug information is compared"

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
cd "$here/../.."
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# Short names, the same under ViSP's namespace and without it.
shorten() {
  sed -E 's/std::__cxx11::basic_string<char, std::char_traits<char>, std::allocator<char> >/std::string/g; s/\[abi:cxx11\]//g
    s/\bvisp:://g; :a; s/, std::(allocator|default_delete)<([^<>]|<([^<>]|<[^<>]*>)*>)*> ?>/>/; ta'
}

# All public headers in one program, of which no type may be left out of the debug information.
flags=(-std=c++17 -g -fno-eliminate-unused-debug-types -femit-class-debug-always -fPIC -shared)
for folder; do
  [ "$folder" = /usr/include ] || flags+=(-isystem "$folder")
done
for folder in modules/*/include; do
  flags+=("-I$folder")
done
for header in modules/*/include/visp3/*/*.h; do
  echo "#include <${header#*/include/}>"
done >"$work/headers.cpp"
"${COMPILER:-g++}" "${flags[@]}" "$work/headers.cpp" -o "$work/headers.so"
"${ABIDW:-abidw}" --load-all-types "$work/headers.so" >"$work/headers.xml"
{
  awk -f "$here/types.awk" "$work/headers.xml"
  # Weak ones are copies of inline functions: which of them are exported is up to the compiler; so are tables of types.
  for library in "$libraries"/libvisp_*.so; do
    nm -DC --defined-only "$library" | sed -nE 's/^[0-9a-f]+ [TDBR] //p'
  done | grep -vE '::Impl::|^_ZT[VIS]'
} | c++filt | shorten | sort -u >"$work/interface.txt"

if [ -n "${VISP_DIRECT_UPDATE_INTERFACE:-}" ]; then
  cp "$work/interface.txt" "$here/interface.txt"
elif ! diff "$here/interface.txt" "$work/interface.txt"; then
  echo "The binary interface is another one (<: as recorded, >: as built). If this is meant, write it down:" >&2
  echo "VISP_DIRECT_UPDATE_INTERFACE=1 ctest -R binaryInterface, and tell it in CHANGELOG.md" >&2
  exit 1
fi
echo "$(wc -l <"$here/interface.txt") types and functions"
