# What the tests of this folder share. To be sourced, with `program` and `work` set.

fail() {
  echo "FAILED: $*" >&2
  exit 1
}

skip() {
  echo "skipped: $*"
  exit 77
}

# A sweep of 40 cases: a fruit that falls, with 39 thresholds.
values=$(seq -s, 0.10 0.01 0.48)
sweep=("$program" sweep "$scene" --set "detach.stretch=$values" --duration "${duration:-2}"
  --no-pictures --quiet)

# What the steps left is the same, to the last bit. The speed of a run is no result: sweep.csv ends
# with it.
same_results() {
  local plain=$1 other=$2 file count=0
  while read -r file; do
    cmp "$plain/$file" "$other/$file" || fail "$file differs"
    count=$((count + 1))
  done < <(cd "$plain" && find . -path ./cluster -prune -o \
    \( -name log.csv -o -name events.csv -o -name log.meta.json \) -print)
  [[ $count == 120 ]] || fail "$count files to compare, expected 3 of each of 40 runs"
  diff <(sed 's/,[^,]*$//' "$plain/sweep.csv") <(sed 's/,[^,]*$//' "$other/sweep.csv") ||
    fail "sweep.csv differs"
}

# Under a final name everything is whole.
whole_results() {
  local folder file
  shopt -s nullglob
  for folder in "$1"/cluster/cases/*/*/; do
    for file in record.json out/result.json out/log.csv out/log.meta.json; do
      [[ -s $folder/$file ]] || fail "$folder has no whole $file"
    done
  done
}

done_cases() {
  find "$1/cluster/cases" -name record.json 2>/dev/null | wc -l
}
