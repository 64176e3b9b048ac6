# Two commands matter: `make demo` and `make test`. Both set up what is missing first.
.DEFAULT_GOAL := help
.PHONY: help demo quick test lint build bench bench-faithful trajectories docs-faps docs-pictures evidence fit-report fit-sheets track-evidence recording-evidence speech-evidence rigs strangers detectors fuzz clean

SETUP = python=$$(sh tools/find_python.sh) && "$$python" tools/environments.py

help: ## this list
	@sed -n 's/^\([a-z-]*\):.*## /  make \1	/p' Makefile | expand -t 20

demo: ## six emotions on the default head: film, .blend and picture in out/
	@sh tools/demo.sh $(ARGS)

quick: ## style, types, layers and the short tests: the inner loop
	@$(SETUP) dev && .venv/bin/python tools/test.py --quick

test: ## every test, on every Blender; STEPS="lint types layers pure bpy-4.5 ..." picks some
	@$(SETUP) dev && .venv/bin/python tools/test.py $(STEPS)

lint: ## style, types and layers
	@$(SETUP) dev && .venv/bin/python tools/test.py lint types layers

build: ## what users install, in dist/; ARGS="--platform linux-x64 --blender 5.1" builds one zip
	@$(SETUP) dev blender && .venv/bin/python tools/build.py $(ARGS)

bench: ## speed and accuracy figures, out/bench/*.json and docs/performance.md; ARGS="motion --head ict.npz" for parts
	@$(SETUP) dev bpy-4.5 && .venv-bpy-4.5/bin/python tools/bench_speed.py $(ARGS)
	@test -n "$(ARGS)" || .venv/bin/python tools/bench_speed.py page

bench-faithful: ## how faithful the faces are: tables and contact sheets in out/faithful/; ARGS="--help" for parts of it
	@$(SETUP) bpy-4.5 && OMP_NUM_THREADS=1 .venv-bpy-4.5/bin/python tools/bench_faithful.py $(ARGS)

trajectories: ## paths of the skin from rest to the six emotions, a picture in out/; ARGS="--timing spontaneous"
	@$(SETUP) bpy-4.5 && OMP_NUM_THREADS=1 .venv-bpy-4.5/bin/python tools/trajectories.py $(ARGS)

docs-faps: ## docs/faps.md: what moves each FAP, measured on the faces
	@$(SETUP) dev && OMP_NUM_THREADS=1 .venv/bin/python tools/fap_table.py $(ARGS)

evidence: ## docs/evidence.md: how well emotions are recognised; ARGS="--part page" writes it anew from out/evidence/
	@$(SETUP) dev bpy-4.5 track && OMP_NUM_THREADS=1 .venv-bpy-4.5/bin/python tools/evidence_seen.py render && OMP_NUM_THREADS=1 .venv-track/bin/python tools/evidence_seen.py read && OMP_NUM_THREADS=1 .venv/bin/python tools/evidence.py $(ARGS)

fit-report: ## docs/fit.md: how well feature points are found on any head; ARGS="--help" for parts of it
	@$(SETUP) dev && OMP_NUM_THREADS=1 .venv/bin/python tools/fit_report.py $(ARGS)

fit-sheets: ## points found on every shared head and the six emotions they make, in out/fit/; ARGS="--help" for parts of it
	@$(SETUP) bpy-4.5 && OMP_NUM_THREADS=1 .venv-bpy-4.5/bin/python tools/fit_sheets.py $(ARGS)

track-evidence: ## docs/tracking.md: how well FAPs come back from films of known streams
	@$(SETUP) bpy-4.5 track && OMP_NUM_THREADS=1 .venv-bpy-4.5/bin/python tools/track_evidence.py films && OMP_NUM_THREADS=1 .venv-track/bin/python tools/track_evidence.py read && OMP_NUM_THREADS=1 .venv-bpy-4.5/bin/python tools/track_evidence.py sheet

speech-evidence: ## docs/speech.md: closures, timing and feelings of speech, read off the meshes
	@$(SETUP) dev && OMP_NUM_THREADS=1 .venv/bin/python tools/speech_evidence.py $(ARGS)

recording-evidence: ## docs/recordings.md: how much of real recordings arrives at the vertices; ARGS="--help" for parts of it
	@$(SETUP) bpy-4.5 && OMP_NUM_THREADS=1 .venv-bpy-4.5/bin/python tools/recording_evidence.py $(ARGS)

rigs: ## docs/rigs.md: how far a character's own keys follow the muscles; ARGS="--sheets" for contact sheets in out/rigs/, too
	@$(SETUP) bpy-4.5 && OMP_NUM_THREADS=1 .venv-bpy-4.5/bin/python tools/rigs.py $(ARGS)

strangers: ## what outside judges see in rendered faces; installs them; ARGS="--whole" writes docs/strangers.md
	@$(SETUP) bpy-4.5 strangers && OMP_NUM_THREADS=1 .venv-bpy-4.5/bin/python tools/ask_strangers.py $(ARGS)

detectors: ## docs/detectors.md: what detectors made by others see in rendered faces; installs them; ARGS=--small tries it on a few
	@$(SETUP) bpy-4.5 track strangers && OMP_NUM_THREADS=1 .venv-bpy-4.5/bin/python tools/ask_detectors.py render $(ARGS) && OMP_NUM_THREADS=1 .venv-track/bin/python tools/ask_detectors.py read $(ARGS) && OMP_NUM_THREADS=1 .venv-bpy-4.5/bin/python tools/ask_detectors.py page $(ARGS)

docs-pictures: ## the manual's pictures, taken in a real Blender window; ARGS="--only wheel" for some of them
	@$(SETUP) dev blender && .venv/bin/python tools/docs_pictures.py $(ARGS)

fuzz: ## damaged files for every reader; ARGS="--seconds 600 --only mesh" for longer or fewer, "--again FILE" for one
	@$(SETUP) bpy-4.5 && OMP_NUM_THREADS=1 .venv-bpy-4.5/bin/python tools/fuzz.py $(ARGS)

clean: ## remove what the commands above made, downloads included
	rm -rf .venv .venv-* .cache .typecheck .mypy_cache .ruff_cache .pytest_cache build dist out *.egg-info
