# The part of a completion for one command.
# -v shell=bash|zsh|fish -v program=agvd -v command=diagram (empty: the program without subcommand)
function about(text) {}
function usage(text) {}
function group(title) {}
function positional(name, text) {}
function heading(text) {}
function line(text) {}
# Of a value such as auto|DEG|off the words that are meant as they stand.
function choices(value,    words, n, i, result) {
    n = split(value, words, "|")
    for (i = 1; i <= n; ++i) {
        if (words[i] ~ /^[a-z][a-z-]+$/) result = result (result == "" ? "" : " ") words[i]
    }
    return result
}
function quoted(text) {
    gsub(/'/, "'\\''", text)
    return text
}
function option(names, value, text,    words, name, n, i, rule) {
    n = split(names, name, ",")
    words = choices(value)
    sub(/[.] (Default:|Required|Needs|Not with).*/, "", text)
    text = quoted(text)
    if (shell == "bash") {
        for (i = 1; i <= n; ++i) all = all " " name[i]
        if (words != "") {
            gsub(/,/, "|", names)
            print "        " names ") words=\"" words "\" ;;"
        }
    } else if (shell == "zsh") {
        gsub(/\[|\]|:/, "\\\\&", text)
        rule = value == "" || value == "[NAME]" ? "" : ":value:" (words == "" ? "_files" : "(" words ")")
        for (i = 1; i <= n; ++i) all = all " \\\n        '*" name[i] "[" text "]" rule "'"
    } else {
        rule = "complete -c " program
        if (command != "") rule = rule " -n '__fish_seen_subcommand_from " command "'"
        for (i = 1; i <= n; ++i) {
            rule = rule (name[i] ~ /^--/ ? " -l " substr(name[i], 3) : " -s " substr(name[i], 2))
        }
        if (words != "") rule = rule " -x -a '" words "'"
        else if (value != "" && value != "[NAME]") rule = rule " -r"
        print rule " -d '" text "'"
    }
}
function subcommand(name, text) {
    commands = commands " " name
    if (shell == "fish") print "complete -c " program " -n __fish_use_subcommand -f -a " name " -d '" quoted(text) "'"
}
function finish() {
    if (shell == "bash") {
        print "        *) [[ $cur != -* ]] || words=\"" substr(all, 2) "\""
        if (commands != "") print "           [[ $cur == -* ]] || words=\"" substr(commands, 2) "\""
        print "           ;;"
    } else if (shell == "zsh") {
        if (commands != "") all = all " \\\n        '1:command:(" substr(commands, 2) ")'"
        print "    _arguments -s" all " \\\n        '*:file:_files' ;;"
    }
}
