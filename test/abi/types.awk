# From the XML of libabigail's abidw, the public types of this repository, one a line: bases, members in their order, virtual
# functions in the order of their table, enumerators. Types of other libraries are named, not looked into.

function attribute(name)
{
  return match($0, " " name "='[^']*'") ? substr($0, RSTART + length(name) + 3, RLENGTH - length(name) - 4) : ""
}

function typeName(id)
{
  return id in base ? (id in before ? before[id] : "") typeName(base[id]) after[id] : id in name ? name[id] : "void"
}

function add(text, id) # an id after the text stands for the name of that type, which may come later
{
  if (own[depth]) {
    parts[scope[depth]] = parts[scope[depth]] SUBSEP text SUBSEP id
  }
}

{ id = attribute("id") }

/<(namespace|class|union|enum)-decl / {
  inner = (depth > 0 ? scope[depth] "::" : "") attribute("name")
  name[id] = inner
  if ($0 !~ /\/>$/) {
    scope[++depth] = inner
    # Once only: a type may be described in several places.
    own[depth] = !/<namespace/ && attribute("filepath") ~ /^modules\/[a-z_]*\/include\// && $0 !~ /is-anonymous/ && !(inner in parts)
    if (own[depth]) {
      parts[inner] = ""
      virtuals[inner] = 0
    }
  }
}
/<\/(namespace|class|union|enum)-decl>/ { --depth }

/<type-decl / { name[id] = attribute("name") }
/<(typedef-decl|pointer-type-def|reference-type-def|qualified-type-def|array-type-def) / {
  base[id] = attribute("type-id")
  after[id] = /<pointer/ ? "*" : /<reference/ ? (attribute("kind") == "rvalue" ? "&&" : "&") : ""
  before[id] = attribute("const") == "yes" ? "const " : ""
  array = id
}
/<subrange / { after[array] = after[array] "[" attribute("length") "]" }
/<function-type / { name[id] = "function" }

/<base-class / { add("base ", attribute("type-id")) }
/<data-member / { member = attribute("static") != "yes" }
/<var-decl / { if (member) add(attribute("name") ": ", attribute("type-id")); member = 0 }
/<enumerator / { add(attribute("name") "=" attribute("value")) }
/<member-function / { place = attribute("vtable-offset"); destructor = attribute("destructor") == "yes" }
/<function-decl / {
  if (place != "" && own[depth]) {
    at = scope[depth] SUBSEP (destructor ? "d" : place)
    if (!(at in virtual)) {
      virtual[at] = attribute("mangled-name")
    }
    if (!destructor && place + 1 > virtuals[scope[depth]]) {
      virtuals[scope[depth]] = place + 1
    }
  }
}
/<return / { if (place != "" && own[depth]) result[at] = attribute("type-id") }
/<\/member-function>/ { place = "" }

END {
  for (type in parts) {
    line = ""
    count = split(parts[type], part, SUBSEP)
    for (i = 2; i < count; i += 2) {
      line = line (line == "" ? "" : "; ") part[i] (part[i + 1] == "" ? "" : typeName(part[i + 1]))
    }
    if ((type SUBSEP "d") in virtual) {
      line = line "; virtual destructor"
    }
    for (i = 0; i < virtuals[type]; ++i) {
      if ((type SUBSEP i) in virtual) {
        line = line "; virtual " virtual[type, i] ": " typeName(result[type, i])
      }
    }
    sub(/^; /, "", line)
    line = type " {" line "}"
    gsub(/&lt;/, "<", line)
    gsub(/&gt;/, ">", line)
    gsub(/&apos;/, "'", line)
    gsub(/&amp;/, "\\&", line)
    print line
  }
}
