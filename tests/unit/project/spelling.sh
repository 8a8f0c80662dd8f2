#!/usr/bin/env bash
# Spelling of the sources and the documentation by codespell: spelling.sh SOURCE_FOLDER. Skipped (77) where it is missing.
set -euo pipefail
command -v codespell > /dev/null || { echo "skipped: codespell is not installed"; exit 77; }
cd "$1"
codespell README.md CHANGELOG.md CONTRIBUTING.md app assets bench cmake core docs lab tests third_party tools
