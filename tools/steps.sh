# shellcheck shell=bash
# Sourced by the other tools: numbered steps, with the time since the start and what each took last time.

steps_total=1
steps_done=0

# steps N: how many steps there will be.
steps() {
  steps_total=$1
  SECONDS=0
}

# step TEXT: the one before has ended well, the next one begins.
step() {
  step_ends
  step_text=$*
  step_began=$SECONDS
  steps_done=$((steps_done + 1))
  local before
  before=$(awk -v text="$*" '{ s = $1; sub(/^[0-9]+ /, "") } $0 == text { last = s } END { print last }' \
    build/step_times 2>/dev/null || true)
  printf '[%d/%d] %s (%s%s)\n' "$steps_done" "$steps_total" "$*" "$(minutes "$SECONDS")" \
    "${before:+; it took $(minutes "$before") last time}"
}

# step_ends: the step has ended well, and how long it took is kept.
step_ends() {
  [[ -z ${step_text:-} ]] || echo "$((SECONDS - step_began)) $step_text" >>build/step_times
  step_text=
}

minutes() { printf '%d:%02d min' $(($1 / 60)) $(($1 % 60)); }

# build_preset NAME [TARGET...]: configures and builds build/NAME (all of it, or the targets).
build_preset() {
  step "configure $1"
  cmake --preset "$1" >"build/configure-$1.log" 2>&1 || {
    cat "build/configure-$1.log" >&2
    return 1
  }
  build_targets "$@"
}

# build_targets NAME [TARGET...]: builds on every core, and says how many jobs are left to do.
build_targets() {
  local jobs
  jobs=$(ninja -C "build/$1" -n "${@:2}" | sed -n '$s|^\[\([0-9]*\)/.*|\1|p')
  step "build $*: ${jobs:-0} jobs on $(nproc) cores"
  local targets=()
  [[ $# -gt 1 ]] && targets=(--target "${@:2}")
  NINJA_STATUS='[%f/%t, %e s] ' cmake --build --preset "$1" --parallel "$(nproc)" "${targets[@]}"
}
