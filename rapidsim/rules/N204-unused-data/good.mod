MODULE example
  PROC main()
    VAR num parts;
    parts:=3;
    WaitTime parts;
  ENDPROC
ENDMODULE
! ---
MODULE near_miss
  PERS num shared_with_other_tasks:=3;
  CONST num layers:=4;
  LOCAL CONST num sizes{layers}:=[1,2,3,4];
  VAR num by_name;
  LOCAL VAR intnum ticked;
  PROC main()
    VAR num sum;
    CONNECT ticked WITH tick;
    ITimer 1,ticked;
    SetDataVal "by_name",reg1;
    FOR i FROM 1 TO Dim(sizes,1) DO
      sum:=sum+sizes{i};
    ENDFOR
    WaitTime sum/100;
  ENDPROC
  TRAP tick
    TPWrite "tick";
  ENDTRAP
ENDMODULE
