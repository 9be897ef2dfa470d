# What comments of weft.h are for Doxygen: those before a declaration, and those behind one; its # is no link.
/^\/\* ----/b
/^#/b
s|( )#|\1\\#|g
s|^( *)/\* |\1/** |
s|^(.*[^ /].*) /\* |\1 /**< |
