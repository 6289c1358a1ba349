MODULE example
  VAR signaldi part_there;
  PROC main()
    WaitDI part_there,1; ! found
  ENDPROC
ENDMODULE
! ---
MODULE bad
  VAR signaldi part_there;
  VAR signalgi part_number;
  PROC main()
    WaitDI part_there,1;                       ! found
    WaitUntil\InPos,part_there=0;             ! found
    WaitGI part_number,3;                      ! found
  ENDPROC
ENDMODULE
