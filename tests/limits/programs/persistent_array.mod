MODULE job
  PERS num counts{2}:=[1,2];
  VAR intnum changed;
  PROC main()
    CONNECT changed WITH tell;
    IPers counts,changed;
    counts{2}:=3;
    WaitTime 1;
    counts:=[4,5];
    WaitTime 1;
  ENDPROC
  TRAP tell
    TPWrite "now "\Num:=counts{2};
  ENDTRAP
ENDMODULE
