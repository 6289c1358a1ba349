! ---
MODULE near_miss
  PROC main()
    WaitDI diFull,1\MaxTime:=9;
    WaitDI diDoor,0\MaxTime:=9;
  ENDPROC
ENDMODULE
