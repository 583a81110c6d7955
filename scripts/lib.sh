# Shared by the scripts beside it; sourced, never run. Needs no /proc and no terminal.
set -euo pipefail
export LC_ALL=C.UTF-8
unset CDPATH
cd "$(dirname "${BASH_SOURCE[0]}")/.."
[ -t 2 ] && terminal=1 || terminal=

# say TEXT: one line of progress, on stderr so that stdout holds results alone.
say() { printf '%s%s\n' "${terminal:+$'\r\e[K'}" "farol: $*" >&2; }

die() {
    say "$*"
    exit 1
}

# progress TEXT PERCENT: redrawn in place on a terminal, else a line every tenth of the way.
last_tenth=-1
progress() {
    local filled=$(($2 / 4)) bar
    bar=$(printf '%*s' "$filled" '')
    if [ -n "$terminal" ]; then
        printf '\r\e[K%s [%-25s] %3d %%' "farol: $1" "${bar// /=}" "$2" >&2
        [ "$2" -lt 100 ] || printf '\n' >&2
    elif [ $(($2 / 10)) -ne "$last_tenth" ]; then
        last_tenth=$(($2 / 10))
        printf 'farol: %s %3d %%\n' "$1" "$2" >&2
    fi
}

# build PRESET TARGET...: configures and builds; shows the share done, and all else ninja says.
build() {
    local preset=$1 target targets=() log
    shift
    for target in "$@"; do targets+=(--target "$target"); done
    mkdir -p build
    log=build/configure-$preset.log
    say "configuring $preset"
    cmake --preset "$preset" >"$log" 2>&1 || { cat "$log" >&2; die "cmake could not configure $preset"; }
    last_tenth=-1
    NINJA_STATUS='[%f/%t] ' cmake --build --preset "$preset" -j "${FAROL_JOBS:-$(nproc)}" \
        "${targets[@]}" 2>&1 | show_build "$preset" || die "the build failed"
}

show_build() {
    local line
    while IFS= read -r line; do
        if [[ $line =~ ^\[([0-9]+)/([0-9]+)\]\  ]]; then
            progress "building $1" $((100 * BASH_REMATCH[1] / BASH_REMATCH[2]))
        elif [ "$line" != "ninja: no work to do." ]; then
            printf '%s%s\n' "${terminal:+$'\r\e[K'}" "$line" >&2
        fi
    done
}

# list_skipped PRESET: every test that was skipped, as a whole or in part, with its reason.
list_skipped() {
    local log=build/$1/Testing/Temporary/LastTest.log
    [ ! -f "$log" ] || awk '
        /^[0-9]+\/[0-9]+ Testing: / { sub(/^[0-9]+\/[0-9]+ Testing: /, ""); name = $0 }
        /^SKIPPED: / { sub(/^SKIPPED: /, ""); lines[++count] = name ": " $0 }
        END {
            if (count) print "Skipped, and why:"
            for (i = 1; i <= count; ++i) print "  " lines[i]
        }' "$log"
}
