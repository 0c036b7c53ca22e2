#!/usr/bin/env bash
# The wheel is made and installed without a network, and works where only it is installed.
#   wheel_test.sh PYTHON SOURCES BUILD
set -euo pipefail
python=$1 sources=$2 build=$3
"$python" -c "import ensurepip, setuptools, wheel, pip" 2> /dev/null || { echo "python3-venv, -setuptools, -wheel or -pip is missing"; exit 77; }
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

"$python" -m venv --system-site-packages "$scratch/venv"
pip=("$scratch/venv/bin/pip" --disable-pip-version-check --quiet)
VLBEAM_BUILD_DIR=$build VLBEAM_JOBS=1 "${pip[@]}" wheel --no-index --no-build-isolation --no-deps --wheel-dir "$scratch/wheels" "$sources"
wheel=$(ls "$scratch"/wheels/vlbeam-*.whl)
extras='[plot]'
"$python" -c "import pandas" 2> /dev/null && extras='[plot,pandas]'
"$python" -c "import matplotlib" 2> /dev/null || extras=
"${pip[@]}" install --no-index "$wheel$extras"

cd "$scratch"
env -u PYTHONPATH MPLBACKEND=Agg "$scratch/venv/bin/python" - "$scratch/venv" "$extras" << 'EOF'
import sys
from pathlib import Path

import vlbeam

assert Path(vlbeam.__file__).is_relative_to(sys.argv[1]), vlbeam.__file__
folder = Path(vlbeam.__file__).parent
for name in ("py.typed", "__init__.pyi", "_scene.pyi", "scenes/falling_beam.json"):
    assert (folder / name).exists(), name
r = vlbeam.run(vlbeam.scene("falling_beam"))
assert abs(r.joint_position[-1] - 0.7125) < 1e-3
if sys.argv[2]:
    assert r.plot().get_title() == "Falling beam with a sliding mass"
print(vlbeam.__version__, "is installed and runs")
EOF
