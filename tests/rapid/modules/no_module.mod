! RAPID Kernel, Module declarations: a file without a module is no program.   ! error: E111
