"""The version of libweft that this package is for: that of weft.h."""
VERSION = "0.2.0"
