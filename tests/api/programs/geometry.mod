MODULE geometry
  RECORD size
    num w;
    num h;
  ENDRECORD
  PERS num nCalls:=0;
  VAR size big:=[3,4];
  VAR robtarget p:=[[600,0,800],[1,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  FUNC num area(num a,num b)
    nCalls:=nCalls+1;
    RETURN a*b;
  ENDFUNC
  LOCAL PROC grow(INOUT num n\num by\switch twice)
    n:=n+1;
    IF Present(by) n:=n+by;
    IF Present(twice) n:=n*2;
  ENDPROC
  PROC fails()
    VAR num x;
    x:=1/nCalls;
  ENDPROC
  FUNC num total(num list{*})
    VAR num s:=0;
    FOR i FROM 1 TO Dim(list,1) DO
      s:=s+list{i};
    ENDFOR
    RETURN s;
  ENDFUNC
  FUNC pos middle(pos a,pos b)
    RETURN (a+b)*0.5;
  ENDFUNC
  PROC set(VAR signaldo d)
    SetDO d,1;
  ENDPROC
  PROC main()
    nCalls:=area(2,3);
  ENDPROC
ENDMODULE
