# shellcheck shell=bash
# Sourced by the other tools: numbered steps with the time since the start.

steps_total=1
steps_done=0

# steps N: how many steps there will be.
steps() {
  steps_total=$1
  SECONDS=0
}

# step TEXT: the next one begins.
step() {
  steps_done=$((steps_done + 1))
  printf '[%d/%d] %s (%s)\n' "$steps_done" "$steps_total" "$*" "$(elapsed)"
}

elapsed() { printf '%d:%02d min' $((SECONDS / 60)) $((SECONDS % 60)); }

# build_preset NAME [TARGET...]: configures and builds build/NAME (all of it, or the targets) on
# every core.
build_preset() {
  step "configure $1"
  cmake --preset "$1" >"build/configure-$1.log" 2>&1 || {
    cat "build/configure-$1.log" >&2
    return 1
  }
  step "build $1"
  local targets=()
  [[ $# -gt 1 ]] && targets=(--target "${@:2}")
  cmake --build --preset "$1" --parallel "$(nproc)" "${targets[@]}"
}
