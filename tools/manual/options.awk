# Reads what --help prints, and hands each part to a function of the file that is read besides:
# about(text), usage(text), positional(name, text), subcommand(name, text), heading(text), line(text),
# finish(), and option(names, value, default_value, text) with names such as "-n,--samples".
# An entry has columns 3 to 30, its text the rest or, if the entry is too long, the next line.
function take_entry(    words, n, i, names, value, default_value, relation) {
    if (entry == "") return
    n = split(entry, words, " ")
    names = words[1]
    for (i = 2; i <= n; ++i) {
        if (words[i] ~ /^(Excludes|Needs):$/) {
            sub(/[.]$/, "", text)
            text = text (words[i] == "Needs:" ? ". Needs" : ". Not with")
            relation = " "
        } else if (relation != "") {
            text = text relation words[i]
            relation = ", "
        } else if (words[i] != "REQUIRED" && words[i] != "...") {
            value = value (value == "" ? "" : " ") words[i]
        }
    }
    if (names ~ /[{]\*[}]$/) value = "[NAME]"
    gsub(/[{][^}]*[}]/, "", names)
    if (match(value, /=[^=]*$/)) {
        default_value = substr(value, RSTART + 1)
        value = substr(value, 1, RSTART - 1)
    }
    sub(/^U?INT:U?INT in /, "", value)
    if (section == "Positionals:") positional(names, text)
    else if (section == "Subcommands:") subcommand(names, text)
    else option(names, value, default_value, text)
    entry = text = ""
}
NR == 1 { about($0); next }
/^Usage: / { usage(substr($0, 8)); next }
/^[A-Z].*:$/ {
    take_entry()
    section = $0
    has_entries = section ~ /^(Positionals|Options|Subcommands):$/
    if (!has_entries) heading(substr($0, 1, length($0) - 1))
    next
}
has_entries && /^                              [^ ]/ {
    entry = entry text
    text = substr($0, 31)
    next
}
has_entries && $0 != "" {
    take_entry()
    entry = substr($0, 3, 28)
    text = substr($0, 31)
    next
}
!has_entries && section != "" { line($0) }
END { take_entry(); finish() }
