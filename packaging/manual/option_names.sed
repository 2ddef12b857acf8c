# help2man sets only the first name of an option in bold where the program writes -o,--output.
s/^\(\\fB[^ ]*\\fR\),\(\\-\\-[^ ]*\)/\1, \\fB\2\\fR/
