MODULE example
  PROC main()
    IF TRUE THEN
    ENDIF
  ENDPROC
ENDMODULE
! ---
MODULE near_miss
  ! if a comment says while, that is fine
  PROC main()
    VAR num Then_Height:=1;
    IF Then_Height>0 TPWrite "while true do";
  ENDPROC
ENDMODULE
