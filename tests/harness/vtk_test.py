#!/usr/bin/env python3
"""The ParaView series opens in a reader that is not ours: meshio (Debian python3-meshio) where it is installed, else
only as XML whose arrays have the lengths they state, and it says so.

vtk_test.py PROGRAM
"""
import json
import os
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as xml

program = sys.argv[1]
# The interpreter of Debian's packages may be another one than the first in the path.
if "VLBEAM_VTK_TEST" not in os.environ:
    try:
        import meshio
    except ImportError:
        if os.path.exists("/usr/bin/python3"):
            os.environ["VLBEAM_VTK_TEST"] = "1"
            os.execv("/usr/bin/python3", ["/usr/bin/python3", *sys.argv])
try:
    import meshio
except ImportError:
    meshio = None

with tempfile.TemporaryDirectory() as folder:
    scene = json.loads(subprocess.run([program, "scene", "pendulum"], check=True, capture_output=True).stdout)
    scene["output"] = {"interval": 0.1, "configurations": [0, 0.1, 0.2]}
    scene["duration"] = 0.2
    report, series = os.path.join(folder, "r.json"), os.path.join(folder, "vtk")
    subprocess.run([program, "run", "-", "--report", report, "--vtk", series, "--points", "5", "-q"], check=True,
                   input=json.dumps(scene).encode())
    with open(report) as file:
        shapes = json.load(file)["configurations"]
    times = []
    for i, entry in enumerate(xml.parse(os.path.join(series, "shape.pvd")).getroot().iter("DataSet")):
        times.append(float(entry.get("timestep")))
        path = os.path.join(series, entry.get("file"))
        piece = xml.parse(path).getroot().find(".//Piece")
        points, cells = int(piece.get("NumberOfPoints")), int(piece.get("NumberOfCells"))
        assert points == 8 * 6 and cells == 8 * 5, (points, cells)
        for array in piece.iter("DataArray"):
            rows = len(array.text.split()) // int(array.get("NumberOfComponents", "1"))
            expected = {"connectivity": 2 * cells, "offsets": cells, "types": cells}.get(array.get("Name"), points)
            assert rows == expected, (array.get("Name"), rows, expected)
        if meshio is None:
            continue
        mesh = meshio.read(path)
        assert mesh.points.shape == (points, 3)
        assert [block.type for block in mesh.cells] == ["line"] and len(mesh.cells[0].data) == cells
        assert sorted(mesh.point_data) == ["axial_strain", "curvature", "material_coordinate", "moment", "shear", "tension", "velocity"]
        for k, r in enumerate(shapes[i]["r"]):  # nodes stand at the elements' ends
            point = mesh.points[min(6 * k, points - 1)]
            assert abs(point[0] - r[0]) < 1e-14 and abs(point[1] - r[1]) < 1e-14 and point[2] == 0
            velocity = mesh.point_data["velocity"][min(6 * k, points - 1)]
            assert abs(velocity[1] - shapes[i]["v"][k][1]) < 1e-12
    assert times == [0, 0.1, 0.2], times
print("read by meshio " + meshio.__version__ if meshio else "read as XML only: meshio is not installed")
