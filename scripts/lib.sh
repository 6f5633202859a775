# shellcheck shell=bash
# What scripts/demo, scripts/test and .ci/run have in common. Sourced, never run.
# Needs bash 5 and, until ensure_packages has run, nothing else but dpkg and apt.

set -euo pipefail
shopt -s inherit_errexit

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd -P)

# Compiled OpenCL kernels belong to the build, not to the user's home, which need not exist.
export POCL_CACHE_DIR=${POCL_CACHE_DIR:-$root/build/pocl_cache}

say() {
    if [[ -t 1 ]]; then
        printf '\033[1m==> %s\033[0m\n' "$*"
    else
        printf '==> %s\n' "$*"
    fi
}

# die MESSAGE...: one line each, to stderr.
die() {
    printf 'error: %s\n' "$1" >&2
    shift
    (($# == 0)) || printf '       %s\n' "$@" >&2
    exit 1
}

# usage: the comment a script begins with.
usage() {
    local line
    while IFS= read -r line; do
        [[ $line != '#!'* ]] || continue
        [[ $line == '#'* ]] || break
        line=${line#'#'}
        printf '%s\n' "${line# }"
    done <"$0"
}

# list_packages GROUP...: the packages of these groups, one a line.
list_packages() {
    local line package group wanted found
    for wanted in "$@"; do
        found=no
        while IFS= read -r line || [[ -n $line ]]; do
            read -r package group _ <<<"${line%%#*}" || true
            if [[ -n $package && $group == "$wanted" ]]; then
                printf '%s\n' "$package"
                found=yes
            fi
        done <"$root/scripts/packages.txt"
        [[ $found == yes ]] || die "scripts/packages.txt has no package in the group '$wanted'"
    done
}

# missing_packages PACKAGE...: those that are not installed, one a line.
missing_packages() {
    local status package
    local -A installed=()
    # dpkg-query fails when any name is unknown to it and still answers for the others.
    while read -r status package; do
        [[ $status != installed ]] || installed[$package]=1
    done < <(dpkg-query --show --showformat='${db:Status-Status} ${Package}\n' "$@" 2>/dev/null || true)
    for package in "$@"; do
        [[ -n ${installed[$package]:-} ]] || printf '%s\n' "$package"
    done
}

is_root() {
    ((EUID == 0))
}

# Runs a command as root: directly, or through sudo, which asks for a password only where someone can type it.
as_root() {
    if is_root; then
        "$@"
    elif [[ -t 0 ]]; then
        sudo -- "$@"
    else
        sudo -n -- "$@"
    fi
}

# ensure_packages GROUP...: installs what is missing, from the repositories this machine already has. Asks for nothing
# and for no network when everything is there.
ensure_packages() {
    local names wanted missing apt
    names=$(list_packages "$@")
    mapfile -t wanted <<<"$names"
    if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
        [[ -z ${SEAGLARE_SKIP_PACKAGES:-} ]] || return 0
        die "this is not a Debian system: there is no apt-get to install packages with." \
            "Install what corresponds to these Debian 12 packages, then set SEAGLARE_SKIP_PACKAGES=1:" "${wanted[*]}"
    fi
    names=$(missing_packages "${wanted[@]}")
    [[ -n $names ]] || return 0
    mapfile -t missing <<<"$names"
    if [[ -n ${SEAGLARE_SKIP_PACKAGES:-} ]]; then
        printf 'warning: not installed, and not to be (SEAGLARE_SKIP_PACKAGES): %s\n' "${missing[*]}" >&2
        return 0
    fi

    say "Installing ${#missing[@]} packages: ${missing[*]}"
    if ! is_root; then
        command -v sudo >/dev/null ||
            die "installing packages needs root, and there is no sudo. As root, run:" \
                "apt-get install --no-install-recommends ${missing[*]}" "and then this script again."
        [[ -t 0 ]] || sudo -n true 2>/dev/null ||
            die "installing packages needs root; sudo wants a password and there is no terminal to ask on. Run first:" \
                "sudo apt-get install --no-install-recommends ${missing[*]}"
    fi
    apt=(env DEBIAN_FRONTEND=noninteractive apt-get -y -o DPkg::Lock::Timeout=300)
    [[ -t 1 ]] || apt+=(-qq -o Dpkg::Use-Pty=0)
    # Old package lists name files the mirror no longer has; but a stale list is better than none.
    as_root "${apt[@]}" update </dev/null ||
        printf 'warning: apt-get update failed; trying with the package lists as they are.\n' >&2
    as_root "${apt[@]}" install --no-install-recommends "${missing[@]}" </dev/null ||
        die "apt-get could not install: ${missing[*]}" \
            "Its message is above. Seaglare is built and tested on Debian 12 (bookworm), main repository;" \
            "without a network, install these packages beforehand."
    names=$(missing_packages "${missing[@]}")
    [[ -z $names ]] || die "apt-get reported success, but these are still missing: ${names//$'\n'/ }"
}

# memory_mib: what this process may use, by the kernel's estimate and by the cgroup's limit.
memory_mib() {
    local key value _ mib=1024 limit used
    while read -r key value _; do
        [[ $key != MemAvailable: ]] || mib=$((value / 1024))
    done </proc/meminfo
    if [[ -r /sys/fs/cgroup/memory.max && -r /sys/fs/cgroup/memory.current ]]; then
        read -r limit </sys/fs/cgroup/memory.max
        read -r used </sys/fs/cgroup/memory.current
        if [[ $limit != max ]]; then
            limit=$(((limit - used) / 1048576))
            ((limit >= mib)) || mib=$limit
        fi
    fi
    printf '%s\n' "$mib"
}

# job_count PROCESSORS MEMORY_MIB: compilers at once, never none. One needs up to a GiB on our largest sources, more
# than that with sanitizers.
job_count() {
    local by_memory=$(($2 / 1024))
    local jobs=$(($1 < by_memory ? $1 : by_memory))
    printf '%s\n' $((jobs > 1 ? jobs : 1))
}

build_jobs() {
    job_count "$(nproc)" "$(memory_mib)"
}

# build PRESET [CMAKE_ARGUMENT...] [--target TARGET...]: configures and builds build/PRESET.
build() {
    local preset=$1 log="$root/build/$1/configure.log" count arguments=() targets=()
    shift
    while (($# > 0)) && [[ $1 != --target ]]; do
        arguments+=("$1")
        shift
    done
    targets=("$@")
    if command -v ccache >/dev/null; then
        arguments+=(-DCMAKE_C_COMPILER_LAUNCHER=ccache -DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
    fi
    mkdir -p "$root/build/$preset"
    say "Configuring build/$preset"
    if ! (cd "$root" && cmake --preset "$preset" "${arguments[@]}") >"$log" 2>&1; then
        cat "$log" >&2
        die "CMake could not configure the preset '$preset'; its message is above." \
            "If the folder was moved or the compiler changed, delete build/$preset and try again."
    fi
    count=$(build_jobs)
    say "Building build/$preset, $count at a time"
    (cd "$root" && cmake --build --preset "$preset" --parallel "$count" "${targets[@]}") ||
        die "the build of the preset '$preset' failed; its first error is above."
}
