# tools/hosts/pack puts program.py here.
