# A man page. -v name=agvd-diagram -v version=0.1.0
function escaped(text) {
    gsub(/\\/, "\\e", text)
    gsub(/-/, "\\-", text)
    gsub(/`/, "\\(ga", text)
    gsub(/'/, "\\(aq", text)
    if (text ~ /^[.]/) text = "\\&" text
    return text
}
function begin(title) {
    if (title == current) return
    if (is_verbatim) print ".fi"
    is_verbatim = 0
    current = title
    print ".SH " toupper(title)
}
function about(text) {
    print ".TH " toupper(name) " 1 \"\" \"remesh " version "\" \"User commands\""
    begin("Name")
    sub(/[.]$/, "", text)
    print name " \\- " escaped(tolower(substr(text, 1, 1)) substr(text, 2))
}
function usage(text) {
    begin("Synopsis")
    print escaped(text)
}
function group(title) {
    if (title == "Positionals") begin("Operands")
    else if (title == "Subcommands") begin("Commands")
    else {
        begin("Options")
        print ".SS " title
    }
}
function positional(operand, text) {
    print ".TP\n.I " operand "\n" escaped(text)
}
function option(names, value, text) {
    gsub(/,/, ", ", names)
    print ".TP\n\\fB" escaped(names) "\\fR" (value == "" ? "" : " \\fI" escaped(value) "\\fR")
    print escaped(text)
}
function subcommand(command, text) {
    print ".TP\n\\fB" command "\\fR\n" escaped(text) ": see\n.BR " name "\\-" command " (1)"
}
function heading(text) {
    begin(text)
    print ".nf"
    is_verbatim = 1
}
function line(text) { print escaped(text) }
function finish() {
    if (is_verbatim) print ".fi"
}
