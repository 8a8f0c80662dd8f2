#!/usr/bin/env bash
# Builds the documentation as a site in out/site. Needs MkDocs and its Material theme: apt install mkdocs-material
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
exec mkdocs build --quiet --strict "$@"
