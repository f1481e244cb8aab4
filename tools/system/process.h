//! \file
//! How a process begins, and how it is asked to end.
#pragma once

namespace cli {

//! Call it first in main(). On Windows it replaces the arguments by the same in UTF-8, in which
//! `*.obj` has become the files there, as programs do that and not shells; the standard streams
//! pass all bytes as they are from then on, and a console shows UTF-8.
void begin_process(int& argc, char**& argv);

//! Calls on_signal(SIGINT or SIGTERM) the first time that the user or the system asks for the end;
//! the next time, the process ends at once. On Windows that is Ctrl-C or Ctrl-Break.
//! \param on_signal  may do only what a signal handler may.
void catch_signals(void (*on_signal)(int));

}  // namespace cli
