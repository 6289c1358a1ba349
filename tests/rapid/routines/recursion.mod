! RAPID Kernel, Routine data: each call has its own, also arrays.
MODULE recursion
  PROC main()
    TPWrite permutations("abc","");       ! -> abc acb bac bca cab cba
  ENDPROC

  FUNC string permutations(string rest,string done)
    VAR string found{3};
    VAR string all;
    VAR string left;
    IF rest="" RETURN done;
    FOR i FROM 1 TO StrLen(rest) DO
      left:="";
      FOR j FROM 1 TO StrLen(rest) DO
        IF j<>i left:=left+StrPart(rest,j,1);
      ENDFOR
      found{i}:=permutations(left,done+StrPart(rest,i,1));
    ENDFOR
    FOR i FROM 1 TO StrLen(rest) DO
      IF all<>"" all:=all+" ";
      all:=all+found{i};
    ENDFOR
    RETURN all;
  ENDFUNC
ENDMODULE
