include Makefile.studies
