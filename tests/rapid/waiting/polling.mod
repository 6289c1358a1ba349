! RAPID Overview, Loops: a loop that looks at a signal again and again lets time pass and ends.
MODULE polling
  VAR signaldo doDone;
  VAR clock watch;

  PROC main()
    VAR num looks;
    AliasIO "doDone",doDone;
    ClkStart watch;
    SetDO\SDelay:=0.55,doDone,1;
    WHILE DOutput(doDone)=0 DO
      looks:=looks+1;
      WaitTime 0.1;
    ENDWHILE
    TPWrite ValToStr(looks);                          ! -> 6
    TPWrite NumToStr(ClkRead(watch),1);               ! -> 0.6
    SetDO doDone,0;
    SetDO\SDelay:=0.25,doDone,1;
    ClkReset watch;
    ClkStart watch;
    WHILE DOutput(doDone)=0 DO
    ENDWHILE
    TPWrite NumToStr(ClkRead(watch),2);               ! -> 0.25
  ENDPROC
ENDMODULE
