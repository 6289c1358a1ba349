MODULE job
  VAR signaldo outs{2};
  VAR signaldo lamp;
  VAR triggdata near;
  VAR intnum soon;
  VAR num n;
  PROC main()
    AliasIO outs,lamp;
    AliasIO "doLamp",outs;
    AliasIO n,lamp;
    AliasIOReset outs;
    IF ValidIO(outs) TPWrite "valid";
    TriggCheckIO near,5,outs,EQ,1,soon;
    Add lamp,1;
    TPWrite ValToStr(outs);
  ENDPROC
ENDMODULE
