// docs/case-file.md.
#include "case/reference.hpp"

#include <fmt/format.h>

#include "case/keys.hpp"

namespace geist {

namespace {

constexpr std::string_view introduction = R"(# The case file

<!-- Made from the key table (src/case/key_table.cpp) by `geist reference`; do not edit. -->

A case is one TOML file: what the bodies are, how they are held and loaded, what to compute, and what to write. It is
validated completely before anything runs. Whatever is wrong is reported at once, each problem with its line and
column, and nothing is written:

```
case.toml:19:1: error: unknown key 'raduis' in 'regions.middle'; did you mean 'radius'?
    19 | raduis = 0.1
       | ^~~~~~
```

`geist check CASE` does only that, and says how the case was understood. [malformed-cases.md](malformed-cases.md) shows
what the messages look like. Editors that know JSON Schema (with the taplo language server, or "Even Better TOML") check
and complete keys while you type, if the file begins with `#:schema` and the path of
[case.schema.json](case.schema.json).

## A complete example

A cantilever with a discrete middle, loaded at its end:

```toml
title = "Cantilever with a discrete middle"
units = { length = "mm", mass = "g", time = "ms" }      # hence N and MPa

[materials.polymer]
density = 0.001
young   = 1000
poisson = 0.2

[regions.left]
type = "hexahedra"
material = "polymer"
box = [[0, 0, 0], [7, 2, 2]]
divisions = [14, 4, 4]

[regions.middle]
type = "lattice"
material = "polymer"
box = [[7, 0, 0], [13, 2, 2]]
radius = 0.1

[regions.right]
type = "hexahedra"
material = "polymer"
box = [[13, 0, 0], [20, 2, 2]]
divisions = [14, 4, 4]

[[supports]]
where = { x = 0 }
fix = ["x", "y", "z"]

[[loads]]
where = { x = 20 }
total_force = [0, 0, -1]

[analysis]
type = "quasi-static"

[probes.tip]
where = { x = 20 }
quantity = "displacement"
component = "z"
```

Names such as `polymer`, `left` and `tip` are yours: letters, digits, `_` and `-`. `[[double brackets]]` make one more
entry of a list; write as many as you need. Numbers may be written with or without a decimal point; infinities and NaN
are refused.

)";

constexpr std::string_view where_and_set = R"(## Balls and cylinders of hexahedra

A ball has a core of hexahedra in its middle and shells of hexahedra from there to its surface, so none is degenerate; a
cylinder has the same in every layer. Its volume, and hence its mass, is that of the hexahedra, a little less than the
ball's own. `minus` cuts along faces of elements only: for a half, a quarter or an eighth the core's number is even, and
across the plane through the centre the grading, if any, is towards `middle` or `ends`. Here a quarter of a ball, finest
at its poles on the z axis, where it may touch something:

```toml
[regions.ball]
type = "hexahedra"
material = "steel"
ball = { centre = [0, 0, 10], radius = 10 }
divisions = [16, 8]                                # core, shells
minus = [{ box = [[-10, -10, 0], [0, 10, 20]] }, { box = [[0, -10, 0], [10, 0, 20]] }]

[regions.ball.grading]
x = { towards = "middle", ratio = 8 }
y = { towards = "middle", ratio = 8 }
radius = { towards = "high", ratio = 8 }

[regions.pin]
type = "hexahedra"
material = "steel"
cylinder = { from = [30, 0, 0], to = [30, 0, 20], radius = 4 }
divisions = [6, 3, 15]                             # core, shells, layers
```

## Selections: `where`

Supports, loads, initial motion and probes act on what `where` selects; if it gives several conditions, all of them must
hold. A plane selects the nodes on it and the particles whose cell touches it; an interval selects nodes and particle
centres within.

```toml
where = { x = 0 }                                  # the face at x = 0
where = { x = [7, 13], region = "middle" }         # the particles from x = 7 to x = 13
where = { x = 20, y = 0 }                          # an edge
```

## Changing a case from the command line: `--set`

`--set PATH=VALUE` changes any value of the case before it is validated, as often as you like; the file stays as it is.
PATH is the key with its tables, joined by dots; entries of a list are counted from 0, and the number after the last one
adds an entry. VALUE is written in TOML; a plain word needs no quotes.

```
geist run case.toml --set regions.middle.radius=0.2 --set regions.left.formulation=full
geist run case.toml --set "regions.left.divisions=[14, 4, 2]" --set "loads.0.total_force=[0, 0, -2]"
geist run case.toml --set regions.middle.type=hexahedra --set "regions.middle.divisions=[12, 4, 4]"
```

Keys of the file that make no sense any more with a value set (here `radius`, for hexahedra) are left out. The complete
case as run, with all defaults and changes, is in `summary.json`.

## Keys

Units are dimensions: `stress` is mass/(length·time²), `force` is mass·length/time², in the file's own units.
)";

constexpr std::string_view coherent = R"(
| length, mass, time | force | stress | density | energy |
|---|---|---|---|---|
| mm, g, ms | N | MPa | g/mm³ | mJ |
| mm, t, s | N | MPa | t/mm³ | mJ |
| m, kg, s | N | Pa | kg/m³ | J |
)";

std::string default_of(const Key& key) {
  if (!key.published.empty())
    return fmt::format("`{}`; `{}` with the published method", key.fallback, key.published);
  if (!key.fallback.empty()) return fmt::format("`{}`", key.fallback);
  if (key.needed) return "required";
  return key.needed_if.always() ? "–" : fmt::format("required where {}", key.needed_if.describe());
}

std::string row(const Key& key) {
  const std::string only = key.only.always() ? "" : fmt::format(" Only where {}.", key.only.describe());
  return fmt::format("| `{}` | {} | {} | {} | {}{} |\n", key.name, key.describe(), key.unit, default_of(key),
                     key.text, only);
}

std::string groups(const Table& table) {
  std::string text;
  for (const Group& group : table.groups) {
    std::vector<std::string> names;
    for (const std::string_view name : group.keys) names.push_back(fmt::format("`{}`", name));
    const std::string when = group.when.always() ? "" : fmt::format(" where {}", group.when.describe());
    text += fmt::format("\n{} of {} must be given{}.\n", group.exclusive ? "Exactly one" : "At least one",
                        join(names, "and"), when);
  }
  return text;
}

std::string section(const Table& table) {
  const bool whole = table.name.empty();
  std::string text = whole ? "\n### The whole file\n" : fmt::format("\n### `{}`\n", table.name);
  if (!whole) text += fmt::format("\nWritten `{}`.", table.heading);
  text += fmt::format("{}{}\n", whole ? "\n" : " ", table.text);
  if (table.name == "units") text += coherent;
  text += "\n| key | value | unit | default | meaning |\n|---|---|---|---|---|\n";
  for (const Key& key : table.keys) text += row(key);
  return text + groups(table);
}

}  // namespace

std::string case_reference_markdown() {
  std::string text(introduction);
  text += where_and_set;
  for (const Table& table : key_table()) text += section(table);
  return text;
}

}  // namespace geist
