! ---
MODULE bad
  PROC main()
    WaitDI diPart,1\MaxTime:=9; ! found
    WaitDI diDoor,0\MaxTime:=9;
  ENDPROC
ENDMODULE
