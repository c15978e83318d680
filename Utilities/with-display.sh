#!/usr/bin/env bash
# Run a command with an X display: the one there is, else a virtual one that ends with the command.
#   bash Utilities/with-display.sh COMMAND [ARG ...]
# Xvfb picks a free display number itself and the command's own exit code comes back; xvfb-run
# promises neither where several run at a time.
set -euo pipefail

[ -z "${DISPLAY:-}" ] || exec "$@"

exec {number}< <(exec setpriv --pdeathsig TERM Xvfb -displayfd 1 -screen 0 1280x1024x24 -noreset -nolisten tcp 2>/dev/null)
server=$!
trap 'kill "$server" && wait "$server" || true' EXIT
read -r -t 60 -u "$number" DISPLAY || { echo "error: the virtual display (Xvfb) did not start" >&2; exit 1; }
DISPLAY=:$DISPLAY "$@"
