# What doxygen is told of a Markdown page, so that the same text reads well on a forge and in the documentation.
# A picture is looked for by the end of its path.
s#(!\[[^]]*\]\()(\.\./)+#\1#g
# `vpClass` is a code span, in which doxygen makes no links; <code> is the same for the eye, and it does.
s#`(vp[A-Z][A-Za-z0-9]*(::[A-Za-z0-9]+)?(\(\))?)`#<code>\1</code>#g
