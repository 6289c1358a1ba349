"""Make the gallery of the published site: recordings and reports of runs, as pages.

    python scripts/build_gallery.py site/gallery

Each page has the viewer in it, some 20 MB, so the gallery is built where the site is, and is not in
the repository. It needs the extra `view`.
"""

from __future__ import annotations

import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from build_pictures import PICTURES, RUNS, Run, simulate

from rapidsim.shipped import filled

PAGE = """<!doctype html>
<html lang="en">
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>rapidsim: recordings to look at</title>
<style>
  :root { color-scheme: light dark }
  body { font: 16px/1.5 system-ui, sans-serif; max-width: 70rem; margin: auto; padding: 1rem }
  figure { margin: 0 }
  main { display: grid; grid-template-columns: repeat(auto-fill, minmax(18rem, 1fr)); gap: 1.5rem }
  img { width: 100%; display: block }
</style>
<h1>Recordings to look at</h1>
<p>Each recording is a page with the viewer, about 20 MB; nothing is installed.</p>
<main>
{{figures}}
</main>
</html>
"""


def main() -> None:
    """Write the gallery to the folder that the command line names."""
    if len(sys.argv) != 2:
        raise SystemExit(__doc__)
    folder = Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    figures = "\n".join(_figure(name, run, folder) for name, run in RUNS.items())
    page = filled(PAGE, {"figures": figures})
    (folder / "index.html").write_text(page, encoding="utf-8", newline="\n")


def _figure(name: str, run: Run, folder: Path) -> str:
    """Write recording and report of a run; return their entry of the index."""
    with tempfile.TemporaryDirectory() as scratch:
        recording, report = Path(scratch) / f"{name}.rrd", folder / f"{name}.html"
        simulate(run, Path(scratch), "--record", str(recording), "--report", str(report))
        command = [sys.executable, "-m", "rapidsim", "view", str(recording), "-q"]
        subprocess.run([*command, "--export", str(folder / name)], check=True)
    picture = PICTURES / f"{name}-2.png"
    shutil.copy(picture, folder)
    image = f'<a href="{name}/index.html"><img src="{picture.name}" alt=""></a>'
    links = f'<a href="{name}/index.html">recording</a>, <a href="{name}.html">report</a>'
    return f"<figure>{image}<figcaption>{run.program}: {links}</figcaption></figure>"


if __name__ == "__main__":
    main()
