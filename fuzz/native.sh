#!/usr/bin/env bash
# Gives made-up problems to the native code that checks them, with libFuzzer and the sanitizers of clang 16 or later:
# native.sh INPUTS
set -euo pipefail
cd "$(dirname "$0")/.."
compiler=$(command -v clang++-{22..16} | head -n 1 || true)
if [ -z "$compiler" ]; then
  echo "clang 16 or later is not installed, so the native code is left out (Debian: apt install clang-16)"
  exit 0
fi
mkdir -p build/fuzz/instances build/fuzz/failures/instances
"$compiler" -std=c++20 -g -O1 -fsanitize=fuzzer,address,undefined -fno-sanitize-recover=undefined -D_GLIBCXX_ASSERTIONS \
  -I native/include -I native/src fuzz/instance.cpp native/src/model/{instance,roadmap}.cpp -o build/fuzz/instance
build/fuzz/instance -runs="$1" -timeout=60 -rss_limit_mb=2048 -verbosity=0 -print_final_stats=1 \
  -artifact_prefix=build/fuzz/failures/instances/ build/fuzz/instances
