#!/usr/bin/env bash
# Debian packages of this checkout in build/package/packages: built for /usr, checked by lintian. --use installs them on this
# machine (as root), builds two small projects on them, by CMake and by pkg-config, runs a program, and removes them.
# DEBFULLNAME and DEBEMAIL name the maintainer; without them the author of the last commit.
set -euo pipefail
case ${1:-} in
'' | --use) ;;
-h | --help) sed -n '2,4s/^# //p' "$0"; exit 0 ;;
*) echo "packages.sh: unknown option $1" >&2; exit 2 ;;
esac
source "$(dirname "${BASH_SOURCE[0]}")/setup.sh"

install_packages "${packages[@]}" doxygen texlive-binaries lintian dpkg-dev file
maintainer=$(git -C "$root" log -1 --format='%an <%ae>')
[ -z "${DEBEMAIL:-}" ] || maintainer="${DEBFULLNAME:-$DEBEMAIL} <$DEBEMAIL>"
build=$root/build/package
launcher=()
command -v ccache >/dev/null && launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
run package-configure.log "Configuring for /usr" cmake -S "$root" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release \
  -DCMAKE_INSTALL_PREFIX=/usr -DVISP_DIRECT_BUILD_TESTS=OFF -DVISP_DIRECT_BUILD_BENCHMARKS=OFF -DVISP_DIRECT_BUILD_TUTORIALS=OFF \
  -DCPACK_PACKAGE_CONTACT="$maintainer" "${launcher[@]}"
run package-build.log "Building" cmake --build "$build" -j "$(job_count)" --target vispdirect_installable doc
rm -rf "$build/packages"/*.deb
run package-cpack.log "Packing" cmake --build "$build" --target package
run package-lintian.log "Checking by lintian" lintian --fail-on error "$build"/packages/*.deb
(cd "$build/packages" && ls -lh ./*.deb)
[ "${1:-}" = --use ] || exit 0

work=$(mktemp -d)
remove() {
  as_root dpkg --purge visp-direct-doc visp-direct libvisp-direct-dev visp-direct-data "$(cd "$build/packages" && ls | sed -n 's/^\(libvisp-direct[0-9.]*\)_.*/\1/p')" \
    >/dev/null 2>&1 || true
  rm -rf "$work"
}
trap remove EXIT
apt_install() { as_root apt-get install -y --no-install-recommends "$@"; }
cd "$build/packages"
run package-install-dev.log "Installing what a project needs" apt_install ./libvisp-direct*.deb ./visp-direct-data_*.deb
run package-cmake.log "A project that uses CMake" bash -c "cmake -S '$root/test/install/consumer' -B '$work/cmake' && cmake --build '$work/cmake' && '$work/cmake/consumer'"
run package-install.log "Installing all packages" apt_install ./*.deb
run package-program.log "A program from its package" bash -c "cd '$work' && visp-servo-compare --law pbvs1 --plant A --out servo && test -s servo/report.html"
run package-pkgconfig.log "The same project by pkg-config" bash -c \
  "c++ -std=c++17 '$root/test/install/consumer/main.cpp' -o '$work/main' \$(pkg-config --cflags --libs visp-direct) && '$work/main'"
