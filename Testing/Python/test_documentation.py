"""The pages tell the truth: their tables are held against the XML and a run of the filter, their Python is run.

Names, labels, defaults, ranges and choices are those of the XML of the source tree; that the proxies have them under
these names is checked on live ones.
"""

import os
import re
import subprocess
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import pytest
import support
from paraview import simple

PROJECT = Path(__file__).resolve().parents[2]
README = PROJECT / "README.md"
GUIDE = PROJECT / "Documentation" / "user-guide.md"
PLUGIN_IN_PAGES = "build/lib/HighOrderParticleIsosurface/HighOrderParticleIsosurface.so"

# Properties whose default ParaView finds in the data: how the tables put it.
FROM_DATA = {
    "Contour By": "first array that looks like a field",
    "Isosurfaces": "middle of the values",
    "Spacing": "1/100 of the longest side",
    "Component": "magnitude",
}


# Pages


def section(page, heading):
    """Lines below a heading, until the next one of any level."""
    lines = page.read_text().splitlines()
    begin = lines.index(heading) + 1
    end = next((i for i in range(begin, len(lines)) if lines[i].startswith("#")), len(lines))
    return lines[begin:end]


def table(page, heading):
    """Rows of the first table below a heading: {column: text of the cell}. A bar in a cell is written '\\|'."""
    lines = [line for line in section(page, heading) if line.startswith("|")]
    assert len(lines) > 2, f"no table below '{heading}' in {page.name}"
    rows = [[cell.strip() for cell in re.split(r"(?<!\\)\|", line)[1:-1]] for line in lines]
    assert all(len(row) == len(rows[0]) for row in rows), f"rows of different lengths below '{heading}'"
    return [dict(zip(rows[0], row)) for row in rows[2:]]


def names_in(rows, column):
    names = [row[column].strip("`") for row in rows]
    assert len(set(names)) == len(names), "a name stands there twice"
    return names


def code_blocks(page):
    """(line number, code, how it is tested) of the blocks marked ```python. How: 'goes on' after the first block of its
    page, or what a comment in the line above says: 'by itself', or 'compiled only: why'."""
    lines = page.read_text().splitlines()
    blocks = []
    for begin, line in enumerate(lines):
        if line == "```python":
            end = lines.index("```", begin + 1)
            how = re.fullmatch("<!-- (by itself|compiled only: .+) -->", lines[begin - 1])
            blocks.append((begin + 2, "\n".join(lines[begin + 1 : end]), how[1] if how else "goes on"))
    return blocks


# What the XML says


def xml_of(file, proxy):
    """{label: element} of the properties of a proxy."""
    root = ElementTree.parse(PROJECT / "Plugin" / file).getroot()
    found = root.find(f".//*[@name='{proxy}']")
    return {label_of(element): element for element in found if element.tag.endswith("Property")}


def label_of(element):
    """As the panel shows it: a name without a label of its own is split at its capitals."""
    return element.get("label") or re.sub(r"(?<=[a-z])(?=[A-Z])", " ", element.get("name"))


def choices_of(element):
    return [entry.get("text") for entry in element.findall("EnumerationDomain/Entry")]


def default_of(element):
    """As the tables write it; None where the data decide."""
    default = element.get("default_values")
    choices = {entry.get("value"): entry.get("text") for entry in element.findall("EnumerationDomain/Entry")}
    return choices.get(default, default)


def limits_of(element):
    """(lowest, highest), None where there is no such limit; those of colours are the same for all components."""
    domain = next((d for d in element if d.tag in ("DoubleRangeDomain", "IntRangeDomain")), None)
    if domain is None:
        return None, None
    ends = [domain.get(end) for end in ("min", "max")]
    return tuple(None if end is None else float(end.split()[0]) for end in ends)


FILTER = xml_of("HighOrderParticleIsosurface.xml", "HighOrderParticleIsosurface")
REPRESENTATION = xml_of("SurfaceSplatRepresentation.xml", "SurfaceSplatRepresentation")
# The representation's other properties are those that Surface has, too.
EXPOSED = ElementTree.parse(PROJECT / "Plugin" / "SurfaceSplatExtension.xml.in").findall(".//ExposedProperties//PropertyGroup/Property")
OWN = {label: e for label, e in REPRESENTATION.items() if e.get("name") in {p.get("name") for p in EXPOSED}}
assert len(OWN) == len(EXPOSED) > 0 and len(FILTER) > 0


def check_default(row, element):
    said = row["default"]
    label = label_of(element)
    if label in FROM_DATA:
        assert said == FROM_DATA[label]
    elif element.tag == "InputProperty":
        assert said == ""
    else:
        assert re.fullmatch("`.*`", said), said
        default = default_of(element)
        try:
            expected, given = ([float(number) for number in text.split()] for text in (default, said.strip("`")))
        except ValueError:
            expected, given = default, said.strip("`")
        assert given == expected, f"{label}: default {default} in the XML, {said} in the table"


def check_range(row, element):
    said = row["range"]
    choices = choices_of(element)
    if choices:
        assert re.findall("`([^`]*)`", said) == choices
    elif element.find("BooleanDomain") is not None:
        assert said == "0 or 1"
    else:
        lowest, highest = limits_of(element)
        number = r"([-+.\de]*\d)"
        both, lower = (re.fullmatch(pattern, said) for pattern in (f"{number} to {number}", f"{number} or more"))
        given = tuple(map(float, both.groups())) if both else (float(lower[1]), None) if lower else (None, None)
        assert given == (lowest, highest), f"{label_of(element)}: {lowest}, {highest} in the XML, '{said}' in the table"


# Tables


GUIDE_TABLES = [
    pytest.param("## Properties of the filter", FILTER, id="filter"),
    pytest.param("## Properties of the representation", OWN, id="representation"),
]


@pytest.mark.parametrize("heading, properties", GUIDE_TABLES)
def test_tables_of_the_guide_have_every_property_and_no_other(heading, properties):
    assert set(names_in(table(GUIDE, heading), "panel")) == set(properties)


@pytest.mark.parametrize("heading, properties", GUIDE_TABLES)
def test_tables_of_the_guide_have_the_defaults_and_ranges_of_the_xml(heading, properties):
    for row in table(GUIDE, heading):
        check_default(row, properties[row["panel"]])
        check_range(row, properties[row["panel"]])
        assert len(row["meaning"]) > 10


def test_names_in_python_are_those_of_the_tables(data):
    """paraview.simple makes names of filters' labels; properties of displays keep those of the XML."""
    particles = particles_of(data)
    rows = table(GUIDE, "## Properties of the filter")
    assert set(names_in(rows, "Python")) == set(particles.ListProperties())
    for row in rows:
        assert row["Python"].strip("`") == row["panel"].replace(" ", "")
    display = simple.Show(particles, simple.CreateView("RenderView"))
    for row in table(GUIDE, "## Properties of the representation"):
        name = row["Python"].strip("`")
        assert OWN[row["panel"]].get("name") == name and name in display.ListProperties()


def test_table_of_the_readme_has_every_property_with_its_default():
    rows = table(README, "## In the GUI")
    assert set(names_in(rows, "property")) == set(FILTER) - {"Input"}
    for row in rows:
        check_default(row, FILTER[row["property"]])


def test_choices_stand_in_the_readme():
    rows = {row["property"]: row["meaning"] for row in table(README, "## In the GUI")}
    for label in ("Quality", "Method"):
        assert all(choice in rows[label] for choice in choices_of(FILTER[label]))


def test_defaults_that_the_data_give_are_as_described(data):
    reader = support.read(data("mfem_hex1_p8.vtu"))
    particles = simple.HighOrderParticleIsosurface(Input=reader)
    grid = support.output_of(reader)
    assert particles.ContourBy == ["POINTS", "u"]
    assert particles.Spacing == pytest.approx(support.longest_side(grid) / 100)
    u = support.array_of(grid, "u")
    low, high = sorted(u)[len(u) // 100], sorted(u)[-1 - len(u) // 100]
    # The values are alike on both sides of their middle, and crowded there.
    assert particles.Isosurfaces[0] == pytest.approx(low + 0.55 * (high - low), abs=0.005 * (high - low))


# Arrays


def particles_of(data):
    reader = support.read(data("mfem_hex1_p8.vtu"))
    return simple.HighOrderParticleIsosurface(Input=reader, ContourBy=["POINTS", "u"], Isosurfaces=[0.2], Spacing=0.1)


def components_of(attributes):
    return {attributes.GetArrayName(i): attributes.GetAbstractArray(i).GetNumberOfComponents()
            for i in range(attributes.GetNumberOfArrays())}


def test_every_point_array_stands_in_the_guide(data):
    particles = particles_of(data)
    rows = table(GUIDE, "### Point arrays")
    names_in(rows, "array")
    assert components_in(rows) == written_by(particles)
    particles.PassDiagnostics = 1
    more = table(GUIDE, "### With Pass Diagnostics")
    names_in(more, "array")
    assert components_in(rows) | components_in(more) == written_by(particles)


def components_in(rows):
    return {row["array"].strip("`"): int(row["components"]) for row in rows}


def written_by(particles):
    """{name: components} of the filter's own point arrays."""
    written = components_of(support.output_of(particles).GetPointData())
    del written["u"]  # the input's
    return written


def test_every_field_array_stands_in_the_guide(data):
    particles = particles_of(data)
    assert support.array_names(support.output_of(particles).GetFieldData()) == set()
    particles.PassDiagnostics = 1
    output = support.output_of(particles).GetFieldData()
    rows = table(GUIDE, "### Field data")
    assert set(names_in(rows, "array")) == support.array_names(output)
    for row in rows:
        if row["values"] != "any number":
            assert output.GetArray(row["array"].strip("`")).GetNumberOfTuples() == int(row["values"])


def test_cell_arrays_are_those_of_the_input(data):
    particles = particles_of(data)
    given = support.array_names(support.output_of(particles.Input).GetCellData())
    assert support.array_names(support.output_of(particles).GetCellData()) == given


# Python of the pages


BLOCKS = [pytest.param(page, *block, id=f"{page.name}:{block[0]}") for page in (README, GUIDE) for block in code_blocks(page)]


@pytest.fixture
def project_folder(tmp_path, monkeypatch):
    """A folder that looks like the top of the project, to write pictures into."""
    for name in ("Testing", "Documentation"):
        (tmp_path / name).symlink_to(PROJECT / name)
    monkeypatch.chdir(tmp_path)
    return tmp_path


def execute(code, page, line, plugin, names):
    """With what its lines have in common with those of the page, for the traceback."""
    padding = "\n" * (line - 1)
    exec(compile(padding + code.replace(PLUGIN_IN_PAGES, str(plugin)), str(page), "exec"), names)


@pytest.mark.parametrize("page, line, code, how", BLOCKS)
def test_python_of_the_pages_runs(page, line, code, how, plugin, project_folder, capfd):
    if how.startswith("compiled only"):
        compile(code, f"{page.name}:{line}", "exec")
    elif how == "by itself":  # classes cannot be imported any more where objects of them were seen before
        subprocess.run([os.environ["HOP_PVPYTHON"], "-c", code], check=True, timeout=120)
    else:
        names = {"__name__": "__main__"}
        first_line, first, _ = code_blocks(page)[0]
        if line != first_line:
            execute(first, page, first_line, plugin, names)
            names["particles"].Spacing = 0.05  # more of them show nothing that fewer would not
        execute(code, page, line, plugin, names)
        for name in re.findall(r'"(\w+\.(?:png|vtp|csv))"', code):
            assert (project_folder / name).stat().st_size > 1000, f"{name} was not written"
        check_colors()
    said = capfd.readouterr().err  # ParaView complains without raising anything
    # What the page says of derived fields is what the filter warns of.
    said = re.sub("[^\n]*at [0-9]+% of the faces between cells that the surface reaches it ends[^\n]*", "", said)
    assert not re.search("error|warning|ERR[|]|WARN[|]", said, re.IGNORECASE), said


def check_colors():
    """ParaView takes the name of any array to colour by, and draws one colour if there is none."""
    for view in simple.GetRenderViews():
        for display in view.Representations:
            if not hasattr(display, "ColorArrayName") or not hasattr(display, "Input"):
                continue  # a legend
            association, name = display.ColorArrayName
            arrays = display.Input.CellData if association == "CELLS" else display.Input.PointData
            assert not name or name in arrays.keys(), f"nothing called {name} to colour by"


def test_few_blocks_are_exceptions():
    assert [how for _, _, how in code_blocks(README)] == ["goes on"]
    hows = [how for _, _, how in code_blocks(GUIDE)]
    assert hows.count("goes on") >= 10
    assert hows.count("by itself") == 1
    assert [how for how in hows if how.startswith("compiled")] == ["compiled only: wants a server"]


def test_script_of_the_readme_has_ten_lines():
    (_, code, _), = code_blocks(README)
    assert sum(bool(line.strip()) for line in code.splitlines()) == 10


# Length


def test_readme_has_at_most_900_words():
    """All of the file counts, its tables and links included, but for code blocks. A word is what stands between
    blanks and has a letter or a digit."""
    text = re.sub(r"^```.*?^```$", "", README.read_text(), flags=re.DOTALL | re.MULTILINE)
    words = [word for word in text.split() if re.search(r"\w", word)]
    assert len(words) <= 900
