# SPDX-License-Identifier: BSD-3-Clause
# shellcheck shell=bash disable=SC2034
# Shared by the scripts beside it (source it, do not run it): which packages are needed for which job, how to
# install them, how to build. This is the only place where packages are listed.

# Debian package names by job; "test" needs "build" as well
packages_build=(gcc libc6-dev cmake ninja-build pkg-config libfyaml-dev libnetcdf-dev)
packages_tidy=("${packages_build[@]}" clang-tidy-14)
packages_test=("${packages_build[@]}" g++ binutils libcmocka-dev universal-ctags clang-format-14
               python3 python3-jsonschema python3-yaml
               python3-dev python3-venv python3-cffi python3-numpy python3-pytest python3-xarray python3-pandas python3-scipy
               python3-matplotlib python3-nbclient python3-ipykernel)

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

say() { printf '%s: %s\n' "${0##*/}" "$*" >&2; }
die() { say "$*"; exit 1; }

# the packages among "$@" that are not installed, one per line
missing_packages() {
    local package
    for package in "$@"; do
        [ "$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null)" = installed ] || printf '%s\n' "$package"
    done
}

# run "$@" as root: directly, or through sudo when it asks nothing or there is somebody to ask
as_root() {
    if [ "$(id -u)" = 0 ]; then "$@"; elif [ -t 0 ]; then sudo "$@"; else sudo -n "$@"; fi
}
can_be_root() {
    [ "$(id -u)" = 0 ] || { command -v sudo >/dev/null && { [ -t 0 ] || sudo -n true 2>/dev/null; }; }
}

# run "$@" with its output kept in a log that is shown only on failure
quietly() {
    local log code=0
    log=$(mktemp)
    "$@" >"$log" 2>&1 || code=$?
    [ $code = 0 ] || cat "$log" >&2
    rm -f "$log"
    return $code
}

apt_get() { as_root env DEBIAN_FRONTEND=noninteractive apt-get -y -o DPkg::Lock::Timeout=300 "$@"; }

# install what is missing of the packages "$@"; costs one dpkg-query each when nothing is
install_packages() {
    local missing
    if ! command -v dpkg-query >/dev/null; then
        say "no Debian packages here: expecting the equivalents of: $*"
        return 0
    fi
    mapfile -t missing < <(missing_packages "$@")
    [ ${#missing[@]} -gt 0 ] || return 0

    can_be_root || die "packages are missing, and installing them needs root or sudo. Run as root, then try again:

    apt-get update && apt-get install -y --no-install-recommends ${missing[*]}
"
    say "installing ${missing[*]}"
    # package lists are fetched only when apt cannot place a package, or when they turn out to be stale
    apt-get -s install "${missing[@]}" >/dev/null 2>&1 || quietly apt_get update || die "apt-get update failed"
    quietly apt_get install --no-install-recommends "${missing[@]}" ||
        { quietly apt_get update && quietly apt_get install --no-install-recommends "${missing[@]}"; } ||
        die "apt-get could not install: ${missing[*]}"
}

# configure preset $1 with the cmake options that follow, and build it in build/$1
build_preset() {
    local preset=$1
    say "building preset '$preset' in build/$preset"
    cd "$root" || return
    quietly cmake --preset "$@" || die "configuring failed; 'rm -r build/$preset' starts afresh"
    cmake --build "build/$preset" || die "the build failed"
}
