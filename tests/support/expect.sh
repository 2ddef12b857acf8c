# shellcheck shell=bash
# Checks exit codes and messages of the program. Source this file in a script.
failed=0

fail() {
  echo "FAILED: $name: $1"
  sed 's/^/    /' log
  failed=$((failed + 1))
}

# expect NAME CODE PATTERN COMMAND...: runs COMMAND. It must end with exit code CODE and print a line that
# matches the extended regular expression PATTERN.
expect() {
  name=$1
  local code=$2 pattern=$3
  shift 3
  "$@" > log 2>&1
  local status=$?
  [ "$status" = "$code" ] || fail "exit code $status, not $code"
  grep -Eq -- "$pattern" log || fail "no message like: $pattern"
  printf '%-34s %s\n' "$name" "$(grep -m 1 '^flytri: ' log)"
}
