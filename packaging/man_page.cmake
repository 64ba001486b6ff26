# dashpot.1 from what the program says of itself: cmake -DPROGRAM= -DVERSION= -DPAGE= -P man_page.cmake
execute_process(COMMAND ${PROGRAM} --help OUTPUT_VARIABLE help COMMAND_ERROR_IS_FATAL ANY)
string(REPLACE "\\" "\\e" help "${help}")
string(REPLACE "-" "\\-" help "${help}")
string(REGEX REPLACE "\n([.'])" "\n\\\\&\\1" help "${help}")
file(WRITE ${PAGE} ".TH DASHPOT 1 \"\" \"Dashpot ${VERSION}\"
.SH NAME
dashpot \\- models of magnetorheological dampers from test\\-bench recordings
.SH SYNOPSIS
.B dashpot
.I COMMAND
[\\fIOPTION\\fR ...]
.SH DESCRIPTION
.nf
${help}
.fi
.SH SEE ALSO
.B dashpot help
.I COMMAND
teaches each command with an example.
")
