! RAPID Instructions, WaitAI and WaitGI: below, above, other than; and the value when time is over.
MODULE values_with_relations
  VAR num last;

  PROC main()
    WaitAI aiFlow,\GT,5\MaxTime:=3;
    TPWrite "above "\Num:=aiFlow;            ! -> above 7.5
    WaitAI aiFlow,\LT,2\MaxTime:=1\ValueAtTimeout:=last;
    WaitGI giType,\NOTEQ,0\MaxTime:=5;
    TPWrite "type "\Num:=giType;             ! -> type 5
    WaitGI giType,6\MaxTime:=5;
    WaitGI giType,\LT,2\MaxTime:=1\ValueAtTimeout:=last;
    SetDO\SDelay:=1.5,doLamp,1;
    WaitDO doLamp,1\MaxTime:=2;
    TPWrite "lamp "\Num:=doLamp;             ! -> lamp 1
  ERROR
    TPWrite "last "\Num:=last;
    ! -> last 7.5
    ! -> last 6
    TRYNEXT;
  ENDPROC
ENDMODULE
