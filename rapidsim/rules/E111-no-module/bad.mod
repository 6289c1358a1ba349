PROC main() ! found
  Stop;
ENDPROC
