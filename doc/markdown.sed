# Filters a Markdown page for doxygen, so that the same text reads well on a forge and in the documentation.
# Doxygen looks up a figure by the end of its path.
s#(!\[[^]]*\]\()(\.\./)+#\1#g
# `vpClass` is a code span, in which doxygen makes no links; <code> looks the same and does get links.
s#`(vp[A-Z][A-Za-z0-9]*(::[A-Za-z0-9]+)?(\(\))?)`#<code>\1</code>#g
