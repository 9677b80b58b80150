# Checks the demo's arguments by its help text, before it is built. Prints what is wrong with the first wrong one and exits with 1.
# Usage: awk -f check_arguments.awk -- help.txt <arguments>

BEGIN {
    read_help(ARGV[1])
    parse_arguments()
    check_together()
    exit 0
}

function refuse(what) {
    print what
    exit 1
}

# An option of the help text: "  --name TYPE:CHECK=default   what it is", where TYPE and the rest are missing from a flag. Lines
# that are too long go on below, broken after commas or at blanks.
function read_help(file, line, option) {
    while ((getline line < file) > 0) {
        if (line ~ /^  -/) {
            read_option(option)
            option = line
        } else {
            sub(/^ +/, "", line)
            option = option (option ~ /,$/ ? "" : "  ") line
        }
    }
    read_option(option)
    close(file)
    known["-h"] = 1
}

function read_option(line, name, rest) {
    if (line ~ /^  -/) {
        match(line, /--[a-z]+/)
        name = substr(line, RSTART, RLENGTH)
        rest = substr(line, RSTART + RLENGTH)
        known[name] = 1
        if (rest ~ /^ [^ ]/) {
            sub(/  .*/, "", rest)
            type[name] = substr(rest, 2)
        }
        if (name == "--device") {
            sub(/.*: /, "", line)
            gsub(/, */, ", ", line)
            devices = line
        }
    }
}

function parse_arguments(i, argument, name, separator) {
    for (i = 2; i < ARGC; ++i) {
        argument = ARGV[i]
        separator = index(argument, "=")
        name = argument ~ /^--/ && separator ? substr(argument, 1, separator - 1) : argument
        if (!(name in known)) {
            refuse("it does not know '" argument "'")
        }
        given[name] = 1
        if (!(name in type)) {
            if (name != argument) {
                refuse(name " takes no value")
            }
        } else if (name != argument) {
            take(name, substr(argument, separator + 1))
        } else if (i + 1 >= ARGC || ARGV[i + 1] in known) {
            refuse(name " needs a value")
        } else {
            take(name, ARGV[++i])
        }
        while (type[name] ~ /\.\.\.$/ && i + 1 < ARGC && ARGV[i + 1] !~ /^-/) {
            take(name, ARGV[++i])
        }
    }
}

function take(name, text, count, i, items) {
    if (type[name] !~ /\.\.\.$/) {
        value[name] = text
        check(name, text)
        return
    }
    count = split(text, items, ",")
    for (i = 1; i <= count; ++i) {
        spaces += name == "--space"
        check(name, items[i])
    }
}

function check(name, text, allowed, bounds) {
    allowed = type[name]
    if (allowed ~ /{.*}/) {
        gsub(/.*{|}.*/, "", allowed)
        if (index("," allowed ",", "," text ",") == 0) {
            refuse(name " is one of " allowed ", not '" text "'")
        }
    } else if (allowed ~ /^(INT|UINT|FLOAT)/) {
        if (!is_number(text, allowed)) {
            refuse(name " needs a number" (allowed ~ /INT/ ? " without a fraction" : "") ", not '" text "'")
        }
        if (allowed ~ /\[/) {
            gsub(/.*\[|\].*/, "", allowed)
            split(allowed, bounds, " - ")
            if (text + 0 < bounds[1] + 0 || text + 0 > bounds[2] + 0) {
                refuse(name " is from " bounds[1] " to " bounds[2] ", not " text)
            }
        }
    } else if (name == "--device" && text !~ /^replay:./ && index(", " devices ",", ", " text ",") == 0) {
        refuse(name " is one of " devices ", not '" text "'")
    }
}

function is_number(text, kind) {
    if (kind ~ /INT/) {
        return text ~ /^[-+]?[0-9]+$/
    }
    return text ~ /^[-+]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][-+]?[0-9]+)?$/
}

# The same as complete() in options.cpp.
function check_together(names, count, i) {
    count = split("--scene --device --law --stiffness --damping --friction --decoupled --fast --rate --record --replay " \
                  "--screenshot", names, " ")
    for (i = 1; i <= count; ++i) {
        if (names[i] in given && ("--compare" in given || spaces > 1)) {
            refuse(names[i] " has no meaning when spaces are compared")
        }
    }
    if ("--headless" in given && "--screenshot" in given) {
        refuse("--screenshot needs a window, and --headless asks for none")
    }
    if ("--replay" in given && "--device" in given) {
        refuse("--replay and --device both say what moves the probe")
    }
    if ("--screenshot" in given && "--seconds" in given &&
        value["--seconds"] + 0 < ("--at" in given ? value["--at"] + 0 : 1)) {
        refuse("the run ends before the time of the screenshot")
    }
}
