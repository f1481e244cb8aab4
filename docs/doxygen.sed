# `#V`, a number of vertices, is no link.
/\/\/!/s/#/\\#/g
