# shellcheck shell=bash
# Sourced by the other tools: what was changed.

# changed_since: where this branch left main; on main itself the commit before.
changed_since() {
  local main base
  for main in origin/main main; do
    base=$(git merge-base "$main" HEAD 2>/dev/null) || continue
    [[ $base != "$(git rev-parse HEAD)" ]] && echo "$base" && return
  done
  git rev-parse --verify --quiet HEAD~1 || echo HEAD
}

# changed_files PATTERN...: the files that were changed since then, with what is not committed yet.
changed_files() {
  {
    git diff --name-only --diff-filter=d "$(changed_since)" -- "$@"
    git ls-files --others --exclude-standard -- "$@"
  } | sort -u
}

# changed_lines PATTERN...: a line a file, its name, a tab and its changed lines as [[first,last],...];
# those with most changes first. Includes and empty lines count as no change, nor does a move.
changed_lines() {
  {
    git diff --find-renames=40% --unified=0 "$(changed_since)" | awk '
      function end_run() { if (first) lines = lines (lines == "" ? "" : ",") "[" first "," at - 1 "]"; first = 0 }
      function end_file() { end_run(); if (lines != "") print file "\t[" lines "]"; lines = "" }
      /^\+\+\+ / { end_file(); file = substr($2, 3); next }
      /^@@ / { end_run(); split(substr($3, 2), place, ","); at = place[1]; next }
      /^\+#include/ { end_run(); at++; next }
      /^\+$/ { at++; next }
      /^\+/ { if (!first) first = at; at++ }
      END { end_file() }'
    git ls-files --others --exclude-standard | sed 's/$/\t[[1,1000000]]/'
  } | awk '{ print length, $0 }' | sort -k1,1nr -k2 | cut -d' ' -f2- | while IFS=$'\t' read -r file lines; do
    local pattern
    for pattern in "$@"; do
      # shellcheck disable=SC2053
      [[ $file == $pattern ]] && printf '%s\t%s\n' "$file" "$lines"
    done
  done
}
