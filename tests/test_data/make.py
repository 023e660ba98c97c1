"""Writes the test data that formulas give: python3 make.py FOLDER [ASSIMP]. What finish.mjs completes is in the folder
`unfinished`, with a list of what to do. ASSIMP: the models of Debian's assimp-testmodels."""

import json
import pathlib
import sys

import animated
import hostile
import models
import surfaces

folder, *assimp = map(pathlib.Path, sys.argv[1:])
unfinished = folder / "unfinished"
unfinished.mkdir()
surfaces.make(folder)
hostile.make(folder, *assimp)
jobs = models.make(folder, unfinished) + animated.make(folder, unfinished)
(unfinished / "jobs.json").write_text(json.dumps(jobs, indent=1))
