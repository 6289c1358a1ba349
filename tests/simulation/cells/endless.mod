MODULE endless
  ! A cell that works until somebody stops it: the conveyor brings a part 1.5 s after each is taken.
  VAR num parts;
  PROC main()
    WHILE TRUE DO
      WaitDI diPart,1;
      parts:=parts+1;
      PulseDO \PLength:=0.2,doTake;
      WaitTime 0.5;
      TPWrite "part "\Num:=parts;
      IF parts MOD 2=0 ExitCycle;
    ENDWHILE
  ENDPROC
ENDMODULE
