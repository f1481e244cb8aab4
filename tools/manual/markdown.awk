# A section of docs/cli.md. -v name='agvd diagram'
function code(text) {
    gsub(/[|]/, "\\|", text)
    return "`" text "`"
}
function cell(text) {
    gsub(/[|*_<]/, "\\\\&", text)
    return text
}
function begin(title) {
    end()
    print "\n### " title "\n"
}
function end() {
    if (is_verbatim) print "```"
    is_verbatim = 0
}
function about(text) { print "\n## " name "\n\n" text }
function usage(text) { print "\n    " text }
function group(title) {
    begin(title == "Positionals" ? "Operands" : title == "Subcommands" ? "Commands" : title)
    print "| | |\n|---|---|"
}
function positional(operand, text) { print "| " code(operand) " | " cell(text) " |" }
function subcommand(command, text) { print "| " code(command) " | " cell(text) " |" }
function option(names, value, text) {
    gsub(/,/, "`, `", names)
    print "| `" names "`" (value == "" ? "" : " " code(value)) " | " cell(text) " |"
}
function heading(text) {
    begin(text)
    print "```text"
    is_verbatim = 1
}
# A blank line before the end of a block is left out.
function line(text) {
    if (text == "") { num_blank++; return }
    for (; num_blank > 0; --num_blank) print ""
    print text
}
function finish() { end() }
