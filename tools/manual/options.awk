# Reads what --help prints, and hands each part to a function of the file that is read besides:
# about(text), usage(text), group(title), positional(name, text), subcommand(name, text),
# option(names, value, text) with names such as "-n,--samples", heading(text) and line(text) for what
# stands after the options, finish().
# An entry begins in column 3. Two blanks or the line's end come after its names; its text goes on in
# lines that begin farther right.
function take_entry(    names, value) {
    if (entry == "") return
    names = value = entry
    sub(/ .*/, "", names)
    if (!sub(/^[^ ]* /, "", value)) value = ""
    if (match(names, /\[=.*\]$/)) {
        value = "[" substr(names, RSTART + 2)
        names = substr(names, 1, RSTART - 1)
    }
    if (section == "Positionals") positional(names, text)
    else if (section == "Subcommands") subcommand(names, text)
    else option(names, value, text)
    entry = text = ""
}
NR == 1 { about($0); next }
/^Usage: / { usage(substr($0, 8)); next }
/^[A-Z].*:$/ {
    take_entry()
    section = substr($0, 1, length($0) - 1)
    # What follows the options begins with one of these.
    is_after_options = is_after_options || section ~ /^(Examples|Exit codes)$/
    if (is_after_options) heading(section)
    else group(section)
    next
}
is_after_options { line($0); next }
/^  [^ ]/ {
    take_entry()
    entry = substr($0, 3)
    if (match(entry, /  +/)) {
        text = substr(entry, RSTART + RLENGTH)
        entry = substr(entry, 1, RSTART - 1)
    }
    next
}
/^   +[^ ]/ {
    sub(/^ +/, "")
    text = text (text == "" ? "" : " ") $0
}
END { take_entry(); finish() }
