"""CalculiX's input: a block of N³ hexahedra of edge 1 cm, steel, one face held, the opposite one pulled, explicit.

CalculiX 2.20 takes its own time step, the Courant estimate below for this edge and material.
"""
TIME_STEP = 1.273862e-06


def deck(n, element, steps):
    """The input of a run of so many steps with elements C3D8 or C3D8R."""
    m = n + 1
    node = lambda i, j, k: 1 + i + m * (j + m * k)
    corners = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
    every = [(i, j, k) for k in range(m) for j in range(m) for i in range(m)]
    lines = ["*NODE,NSET=NALL"]
    lines += [f"{node(i, j, k)},{i * 0.01:.4f},{j * 0.01:.4f},{k * 0.01:.4f}" for i, j, k in every]
    lines.append(f"*ELEMENT,TYPE={element},ELSET=EALL")
    cells = [(i, j, k) for i, j, k in every if max(i, j, k) < n]
    for number, (i, j, k) in enumerate(cells, 1):
        lines.append(",".join(map(str, [number] + [node(i + a, j + b, k + c) for a, b, c in corners])))
    for name, x in ("HELD", 0), ("PULLED", n):
        lines.append(f"*NSET,NSET={name}")
        lines += [str(node(i, j, k)) for i, j, k in every if i == x]
    lines += ["*MATERIAL,NAME=STEEL", "*ELASTIC", "210e9,0.3", "*DENSITY", "7800.",
              "*SOLID SECTION,ELSET=EALL,MATERIAL=STEEL", "*BOUNDARY", "HELD,1,3", f"*STEP,INC={steps * 50}",
              "*DYNAMIC,EXPLICIT", f"{TIME_STEP},{TIME_STEP * (steps - 0.5)}", "*CLOAD", "PULLED,1,1000.",
              "*NODE FILE,FREQUENCY=1000000", "U", "*END STEP"]
    return "\n".join(lines) + "\n"
